#include "registration/mammogram/mammogram_header.h"
#include "registration/mammogram/mammogram_pixels.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void mammogram_dicom(const std::string& bytes) {
  const auto path = fuzzed_file("a.dcm", bytes);
  if (!is_dicom(path)) return;
  read_mammogram_header(path);
  read_mammogram_dicom(path);
}

}  // namespace mammotwin::fuzz
