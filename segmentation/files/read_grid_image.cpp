#include "segmentation/files/read_grid_image.h"

#include <stdexcept>

#include "segmentation/files/read_raw_image.h"

namespace mammotwin {

namespace fs = std::filesystem;

void check_is_there(const fs::path& path) {
  if (!fs::is_regular_file(path) && !fs::is_directory(path))
    throw std::runtime_error(
        "does not exist or is no file; expected a folder with a DICOM series, or a DICOM, "
        "NIfTI, NRRD or MetaImage file");
  if (fs::is_regular_file(path) && fs::file_size(path) == 0)
    throw std::runtime_error("is empty (0 bytes); expected an image (copy or export it again)");
}

GridImage read_grid_image(const fs::path& path, HeaderKeys* keys) {
  RawImage raw = read_raw_image(path, keys);
  GridImage image;
  image.size = Eigen::Map<const Eigen::Vector3i>(raw.size.data());
  image.spacing = Eigen::Map<const Eigen::Vector3d>(raw.spacing.data());
  image.origin = Eigen::Map<const Eigen::Vector3d>(raw.origin.data());
  image.direction =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(raw.direction.data());
  image.values = std::move(raw.values);
  return image;
}

}  // namespace mammotwin
