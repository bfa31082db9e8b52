#include "segmentation/mri/read_mri.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void nifti(const std::string& bytes) {
  const bool packed = bytes.starts_with("\x1f\x8b");
  read_mri(fuzzed_file(packed ? "a.nii.gz" : "a.nii", bytes));
}

}  // namespace mammotwin::fuzz
