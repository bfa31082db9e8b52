#include "registration/prediction/project_lesions.h"

#include <utility>

namespace mammotwin {

ViewProjection::ViewProjection(const HermiteMesh& prone, const HermiteMesh& compressed,
                               CompressedView view, Detector detector,
                               std::optional<AffineBaseline> baseline)
    : view_(std::move(view)),
      detector_(std::move(detector)),
      compressed_from_prone_(prone, compressed),
      baseline_(baseline ? *baseline : AffineBaseline(prone, view_)) {
  check_detector(detector_);
}

ProjectedLandmark ViewProjection::project(const Landmark& landmark) const {
  const CarriedPoint carried = compressed_from_prone_.carry(landmark.prone_in_lps);
  ProjectedLandmark result;
  result.landmark = landmark;
  result.point = carried.point;
  result.outside_mm = carried.outside_mm;
  result.compressed_in_lps = carried.in_lps;
  result.in_view = view_.frame.view_from_lps(carried.in_lps);
  result.on_detector = detector_.project(result.in_view);
  if (detector_.pixels) result.in_image = detector_.image_from_detector(result.on_detector);
  if (detector_.slices) result.slice = detector_.slices->slice_at(result.in_view.z());
  result.baseline_on_detector = detector_.project(baseline_.view_from_prone(landmark.prone_in_lps));
  return result;
}

}  // namespace mammotwin
