#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "registration/prediction/project_lesions.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// One row of `lesions.csv`: a lesion in one view ("cc", "mlo", ...), or in the prone MRI itself
/// (view "mri"). What is not known is empty. What each column holds: docs/lesions_table.md.
struct LesionRow {
  std::string patient, lesion, view, side;
  std::optional<double> volume_ml;
  std::optional<double> mri_l_mm, mri_p_mm, mri_s_mm;
  std::optional<double> depth_mm, lateral_mm, height_mm;
  std::optional<double> detector_u_mm, detector_v_mm, pixel_column, pixel_row, slice;
  std::string registration;
  std::optional<double> ellipse_major_mm, ellipse_minor_mm, ellipse_angle_deg;
  std::optional<double> picture_ellipse_major_mm, picture_ellipse_minor_mm,
      picture_ellipse_angle_deg;
  std::optional<double> baseline_u_mm, baseline_v_mm;
  std::optional<double> behind_nipple_mm, lateral_of_nipple_mm, above_nipple_mm, nipple_distance_mm;
  std::string quadrant, clock, third;
  std::optional<double> supine_skin_l_mm, supine_skin_p_mm, supine_skin_s_mm;
  std::optional<double> supine_depth_mm, supine_from_nipple_mm;
  std::string supine_clock;
  std::optional<double> supine_semi_l_mm, supine_semi_p_mm, supine_semi_s_mm;
};

/// In the MRI: nipple distances along the patient's axes, quadrant and hour.
LesionRow mri_row(const std::string& patient, Side side, const Landmark& lesion,
                  const Eigen::Vector3d& nipple_in_lps);

/// In a view: nipple distances on the detector; across the image they are `lateral_of_nipple_mm` in
/// a view within 15 degrees of CC and `above_nipple_mm` in any other. Quadrant and hour are those
/// of the MRI.
LesionRow view_row(const std::string& patient, const CompressedView& view,
                   const ProjectedLandmark& lesion, const ProjectedLandmark& nipple);

/// Gives each row its lesion's volume and third of the breast's depth.
void add_extent(const Segmentation& segmentation, std::vector<LesionRow>& rows);

/// RFC 4180 with a header line; lengths to 0.001.
void write_lesion_table(const std::filesystem::path& path, const std::vector<LesionRow>& rows);

/// The table's columns with units and meanings, in Markdown.
void write_lesion_dictionary(const std::filesystem::path& path);

/// Throws std::runtime_error naming the file, line and column that cannot be read.
std::vector<LesionRow> read_lesion_table(const std::filesystem::path& path);

}  // namespace mammotwin
