#include "solver/press/checkpoint.h"

#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void checkpoint(const std::string& bytes) {
  decode_checkpoint({bytes.begin(), bytes.end()}, "run");
}

}  // namespace mammotwin::fuzz
