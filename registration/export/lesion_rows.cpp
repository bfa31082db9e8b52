
#include "registration/export/lesion_table.h"
#include "registration/view/breast_position.h"

namespace mammotwin {
namespace {

LesionRow row_of(const std::string& patient, Side side, const Landmark& lesion,
                 const Eigen::Vector3d& nipple_in_lps) {
  const BreastPosition place = breast_position(side, lesion.prone_in_lps, nipple_in_lps);
  LesionRow row;
  row.patient = patient;
  row.lesion = lesion.id;
  row.side = side == Side::left ? "left" : "right";
  row.mri_l_mm = lesion.prone_in_lps.x();
  row.mri_p_mm = lesion.prone_in_lps.y();
  row.mri_s_mm = lesion.prone_in_lps.z();
  row.quadrant = place.quadrant;
  row.clock = place.clock;
  return row;
}

}  // namespace

LesionRow mri_row(const std::string& patient, Side side, const Landmark& lesion,
                  const Eigen::Vector3d& nipple_in_lps) {
  LesionRow row = row_of(patient, side, lesion, nipple_in_lps);
  const Eigen::Vector3d offset = lesion.prone_in_lps - nipple_in_lps;
  row.view = "mri";
  row.behind_nipple_mm = offset.y();
  row.lateral_of_nipple_mm = side == Side::left ? offset.x() : -offset.x();
  row.above_nipple_mm = offset.z();
  row.nipple_distance_mm = offset.norm();
  return row;
}

LesionRow view_row(const std::string& patient, const CompressedView& view,
                   const ProjectedLandmark& lesion, const ProjectedLandmark& nipple) {
  LesionRow row = row_of(patient, view.side, lesion.landmark, nipple.landmark.prone_in_lps);
  row.view = view.name;
  row.depth_mm = lesion.in_view.x();
  row.lateral_mm = lesion.in_view.y();
  row.height_mm = lesion.in_view.z();
  row.detector_u_mm = lesion.on_detector.x();
  row.detector_v_mm = lesion.on_detector.y();
  if (lesion.in_image) {
    row.pixel_column = lesion.in_image->x();
    row.pixel_row = lesion.in_image->y();
  }
  row.slice = lesion.slice;
  row.baseline_u_mm = lesion.baseline_on_detector.x();
  row.baseline_v_mm = lesion.baseline_on_detector.y();
  const Eigen::Vector2d offset = lesion.on_detector - nipple.on_detector;
  row.behind_nipple_mm = -offset.x();
  const bool cranio_caudal = !is_oblique(view.angle_deg);
  (cranio_caudal ? row.lateral_of_nipple_mm : row.above_nipple_mm) = offset.y();
  row.nipple_distance_mm = offset.norm();
  return row;
}

void add_extent(const Segmentation& segmentation, std::vector<LesionRow>& rows) {
  for (LesionRow& row : rows)
    for (const Lesion& lesion : segmentation.lesions) {
      if (lesion.id != row.lesion) continue;
      if (lesion.volume_ml > 0) row.volume_ml = lesion.volume_ml;
      row.third = depth_third(segmentation, lesion.centroid_in_lps);
    }
}

}  // namespace mammotwin
