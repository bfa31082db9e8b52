#include "segmentation/mri/read_mri.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void meta_image(const std::string& bytes) { read_mri(fuzzed_file("a.mha", bytes)); }

}  // namespace mammotwin::fuzz
