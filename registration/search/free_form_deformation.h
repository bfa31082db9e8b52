#pragma once

#include <Eigen/Core>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// A smooth displacement in the plane of a view, the same at all heights: cubic B-splines over a
/// grid of controls 25 mm apart (Rueckert et al., IEEE TMI 18 (1999) 712-721). Beyond the grid it
/// is that of its border.
class FreeFormDeformation {
 public:
  FreeFormDeformation() = default;  ///< moves nothing

  /// Controls for all (depth, lateral) between two corners [mm], at 0.
  FreeFormDeformation(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

  /// Displacement at (depth, lateral) [mm], or its derivative of these orders, up to 3 together.
  Eigen::Vector2d at(const Eigen::Vector2d& x, int by_depth = 0, int by_lateral = 0) const;

  /// A node's parameters [mm, view frame] once its tissue is displaced: those of x + at(x).
  HermiteMesh::Node moved(const HermiteMesh::Node& node) const;

  const Eigen::Matrix2Xd& controls() const { return controls_; }
  void set_controls(const Eigen::Matrix2Xd& controls_mm) { controls_ = controls_mm; }

  /// Middle of a control's spline, (depth, lateral) [mm].
  Eigen::Vector2d middle(Eigen::Index control) const;

 private:
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();  // middle of control 0
  int columns_ = 0, rows_ = 0;
  Eigen::Matrix2Xd controls_;  // along depth fastest
};

}  // namespace mammotwin
