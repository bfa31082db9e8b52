#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mammotwin {

/// Where a tomosynthesis volume says that its slices lie.
struct SliceTags {
  std::optional<double> spacing_mm, thickness_mm;            ///< (0018,0088), (0018,0050)
  std::optional<Eigen::Vector3d> first_in_lps, last_in_lps;  ///< (0020,0032) of these slices
};

/// What a mammogram's DICOM header says of its geometry, as it stands there: text without padding,
/// empty where a tag is missing. No identifier is read.
struct MammogramHeader {
  std::string modality, positioner_type, presentation_intent, paddle, implant, partial_view;
  std::string view_position, view_code, view_code_meaning;  ///< (0018,5101), (0054,0220)
  std::vector<std::string> view_modifiers;                  ///< meanings in (0054,0222)
  std::string image_laterality, laterality;                 ///< (0020,0062), (0020,0060)
  std::vector<std::string> patient_orientation;             ///< of rows, of columns
  std::optional<double> primary_angle_deg, thickness_mm, force, source_to_detector_mm,
      source_to_patient_mm, magnification;
  std::vector<std::string> image_type;  ///< (0008,0008)
  std::vector<double> imager_spacing_mm, pixel_spacing_mm,
      element_spacing_mm;  ///< between rows, between columns; the last of the detector itself
  std::optional<int> collimated_left, collimated_right;  ///< columns of (0018,1702) and (0018,1704)
  std::optional<int> rows, columns, frames;
  std::optional<SliceTags> slices;  ///< of a Breast Tomosynthesis Image
};

/// Throws std::runtime_error naming the file where it is no DICOM file, or a tomosynthesis volume
/// without its functional groups.
MammogramHeader read_mammogram_header(const std::filesystem::path& path);

/// True where the file begins as DICOM files do.
bool is_dicom(const std::filesystem::path& path);

}  // namespace mammotwin
