#include "segmentation/files/read_image.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "segmentation/files/read_dicom_series.h"
#include "segmentation/files/read_raw_image.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

void check_exists(const fs::path& path) {
  if (!fs::is_regular_file(path) && !fs::is_directory(path))  // a pipe or a device may never end
    throw std::runtime_error(
        "does not exist or is no file; expected a folder with a DICOM series, or a DICOM, "
        "NIfTI, NRRD or MetaImage file");
  if (fs::is_regular_file(path) && fs::file_size(path) == 0)
    throw std::runtime_error("is empty (0 bytes); expected an image (copy or export it again)");
}

GridImage read_grid(const fs::path& path) {
  RawImage raw = read_raw_image(path);
  GridImage image;
  image.size = Eigen::Map<const Eigen::Vector3i>(raw.size.data());
  image.spacing = Eigen::Map<const Eigen::Vector3d>(raw.spacing.data());
  image.origin = Eigen::Map<const Eigen::Vector3d>(raw.origin.data());
  image.direction =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(raw.direction.data());
  image.values = std::move(raw.values);
  return image;
}

void check_finite(const GridImage& image) {
  std::size_t bad = 0;
  for (const float value : image.values) bad += !std::isfinite(value);
  if (bad > 0)
    throw std::runtime_error("has " + std::to_string(bad) + " of " +
                             std::to_string(image.values.size()) +
                             " values that are not finite (NaN or infinite); expected numbers "
                             "only (replace them before)");
}

void check_signal(const GridImage& image) {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (const float value : image.values) low = std::min(low, value), high = std::max(high, value);
  if (!(high > low))
    throw std::runtime_error("has one and the same value everywhere; expected an image");
}

}  // namespace

Mri read_mri(const fs::path& path, const std::optional<std::string>& series) {
  Mri mri;
  GridImage image;
  try {
    check_exists(path);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  if (fs::is_directory(path) || !is_image_file_name(path)) {
    DicomVolume dicom = read_dicom_series(path, series);
    image = std::move(dicom.image);
    mri.files = std::move(dicom.files);
    mri.notes = std::move(dicom.notes);
    mri.series = std::move(dicom.series);
    mri.patient_position = dicom.patient_position;
    mri.geometry_known = dicom.geometry_known;
  } else {
    try {
      image = read_grid(path);
    } catch (const std::exception& error) {
      throw std::runtime_error(path.string() + ": " + error.what());
    }
    mri.files = {path};
  }
  try {
    check_finite(image);
    check_signal(image);
    mri.image = to_lps_grid(std::move(image), Between::linear, mri.notes);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return mri;
}

Volume<std::uint16_t> read_labels(const fs::path& path) {
  try {
    check_exists(path);
    if (!is_image_file_name(path))
      throw std::runtime_error("is not a label map; expected .nii, .nii.gz, .nrrd, .mha or .mhd");
    std::vector<std::string> notes;
    const Volume<float> raw = to_lps_grid(read_grid(path), Between::nearest, notes);
    auto labels = raw.like<std::uint16_t>();
    for (std::size_t n = 0; n < raw.values.size(); ++n) {
      const float value = raw.values[n];
      if (!(value >= 0 && value <= 65535 && value == std::floor(value)))
        throw std::runtime_error("has the value " + std::to_string(value) +
                                 "; expected whole label numbers from 0 to 65535");
      labels.values[n] = static_cast<std::uint16_t>(value);
    }
    return labels;
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace mammotwin
