#include "segmentation/mri/read_mri.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void nrrd(const std::string& bytes) { read_mri(fuzzed_file("a.nrrd", bytes)); }

}  // namespace mammotwin::fuzz
