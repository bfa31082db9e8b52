#pragma once

#include <optional>
#include <string>
#include <vector>

#include "registration/carry/point_carrier.h"
#include "registration/prediction/affine_baseline.h"
#include "registration/view/compressed_view.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// A lesion's centroid or the nipple, in the prone MRI.
struct Landmark {
  std::string id;
  Eigen::Vector3d prone_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
};

/// Where a landmark comes to lie in one view.
struct ProjectedLandmark {
  Landmark landmark;
  MeshPoint point;
  double outside_mm = 0;  ///< distance of the landmark from the mesh in the prone MRI
  Eigen::Vector3d compressed_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  Eigen::Vector3d in_view = Eigen::Vector3d::Zero();            ///< depth, lateral, height [mm]
  Eigen::Vector2d on_detector = Eigen::Vector2d::Zero();        ///< u, v [mm]
  std::optional<Eigen::Vector2d> in_image;                      ///< column, row
  std::optional<double> slice;  ///< of a tomosynthesis volume, from 1, with fractions
  Eigen::Vector2d baseline_on_detector = Eigen::Vector2d::Zero();  ///< u, v without physics [mm]
};

/// One compressed view of one breast, ready for any number of points.
class ViewProjection {
 public:
  ViewProjection(const HermiteMesh& prone, const HermiteMesh& compressed, CompressedView view,
                 Detector detector, std::optional<AffineBaseline> baseline = {});

  ProjectedLandmark project(const Landmark& landmark) const;

  const CompressedView& view() const { return view_; }
  const Detector& detector() const { return detector_; }
  const AffineBaseline& baseline() const { return baseline_; }

 private:
  CompressedView view_;
  Detector detector_;
  PointCarrier compressed_from_prone_;
  AffineBaseline baseline_;
};

/// A lesion further outside the mesh than this [mm] has no trustworthy position: `register`
/// refuses. The nipple may stand out of a smooth skin surface, so it is not held to this.
inline constexpr double kLesionOutsideLimit_mm = 3;

}  // namespace mammotwin
