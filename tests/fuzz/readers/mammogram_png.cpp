#include "registration/mammogram/mammogram_picture.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void mammogram_png(const std::string& bytes) {
  read_mammogram_picture(fuzzed_file("a.png", bytes));
}

}  // namespace mammotwin::fuzz
