#include "segmentation/mri/read_mri.h"
#include "tests/fuzz/readers/reader.h"
#include "tests/segmentation/files/dicom_writer.h"

namespace mammotwin::fuzz {

/// A slice of a series whose others are whole.
void dicom_mri(const std::string& bytes) {
  static const std::filesystem::path folder = [] {
    const auto path = fuzzed_file("mri.txt", "").replace_filename("mri");
    Volume<float> image({8, 8, 4}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 5);
    image(3, 3, 2) = 9;
    write_dicom_series(path, "", DicomHeader(), image);
    return path;
  }();
  std::ofstream(folder / "0003.dcm", std::ios::binary) << bytes;
  read_mri(folder);
}

}  // namespace mammotwin::fuzz
