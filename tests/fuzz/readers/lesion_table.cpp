#include "registration/export/lesion_table.h"

#include "registration/export/predictions_text.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void lesion_table(const std::string& bytes) {
  predictions_text(read_lesion_table(fuzzed_file("lesions.csv", bytes)));
}

}  // namespace mammotwin::fuzz
