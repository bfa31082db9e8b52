#include "segmentation/mri/read_mri.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "segmentation/files/read_grid_image.h"
#include "segmentation/files/read_raw_image.h"
#include "segmentation/mri/read_dicom_series.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

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
    check_is_there(path);
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
      image = read_grid_image(path);
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

}  // namespace mammotwin
