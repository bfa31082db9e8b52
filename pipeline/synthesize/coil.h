#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/synthesize/chest.h"

namespace mammotwin {

/// A breast coil: loops round both breasts. Its sensitivity is the root sum of squares of
/// (R^2 / (R^2 + d^2))^1.2 over the loops at distance d (study of segmentation, section 1; the
/// field on the axis of a loop falls with the power 1.5).
class Coil {
 public:
  /// `radius_mm` R of the loops. The sensitivity is 1 at `reference`.
  Coil(std::vector<Eigen::Vector3d> loops, double radius_mm, const Eigen::Vector3d& reference);

  double sensitivity(const Eigen::Vector3d& x) const;

  /// `exponent` 0: the same everywhere; 1: the law above. On `grid`, from nodes 6 mm apart.
  Volume<float> shading(const Volume<float>& grid, double exponent) const;

 private:
  double raw(const Eigen::Vector3d& x) const;

  std::vector<Eigen::Vector3d> loops_;
  double squared_radius_, scale_ = 1;
};

/// Loops beside, above and below both breasts; the reference is the middle of `side`'s breast.
Coil coil_round(const Chest& chest, Side side, double radius_mm);

}  // namespace mammotwin
