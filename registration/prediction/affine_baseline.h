#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {

/// The prediction without physics that the model has to beat: an affine map, in the view frame, of
/// the prone breast to the compressed thickness that keeps its volume.
///
///   depth'   = r depth                    held at the detector's chest-wall edge
///   lateral' = c + r (lateral - c)        held at the lateral centroid c of the prone breast
///   height'  = (height - low) / r^2       r^2 = prone extent / compressed thickness
///
/// The prone extent [low, high] along the beam is that of the tissue in front of the edge
/// (depth > 0), which is what the plates squeeze. In-plane stretch r both ways, so det = 1.
class AffineBaseline {
 public:
  /// Throws std::invalid_argument if no part of the breast lies in front of the edge.
  AffineBaseline(const HermiteMesh& prone, const CompressedView& view);

  /// Point of the prone breast [mm, LPS] -> its place in the view frame.
  Eigen::Vector3d view_from_prone(const Eigen::Vector3d& x_in_lps) const;

  /// Its inverse.
  Eigen::Vector3d prone_from_view(const Eigen::Vector3d& x_in_view) const;

  /// Turned about the beam and shifted on the detector, to be brought to a mammogram's outline.
  void place(double turn_deg, const Eigen::Vector2d& shift_mm);

  const ViewFrame& frame() const { return frame_; }
  double thickness_mm() const { return thickness_mm_; }
  double turn_deg() const { return turn_deg_; }
  const Eigen::Vector2d& shift_mm() const { return shift_; }
  double stretch() const { return stretch_; }
  double prone_extent_mm() const { return prone_extent_mm_; }
  double prone_low_mm() const { return low_; }  ///< lowest height of the prone tissue in front

 private:
  ViewFrame frame_;
  double thickness_mm_ = 0, prone_extent_mm_ = 0;
  double stretch_ = 1;
  double low_ = 0;
  double lateral_centroid_ = 0;
  double turn_deg_ = 0;
  Eigen::Matrix2d turn_ = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift_ = Eigen::Vector2d::Zero();
};

}  // namespace mammotwin
