#pragma once

#include <Eigen/Core>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Tissue of a piece of breast: mean fractions over the voxels of a cube of `volume` [mm^3] around
/// a point, so that a quadrature point sees its cell and not one voxel. Voxels outside the breast
/// do not count; where there are none in the cube (a mesh that leaves the labels by less than a
/// cell), the answer is fat. The result sums to 1.
class MeanFractions {
 public:
  /// Keeps a reference to `fractions`.
  explicit MeanFractions(const Volume<Fractions>& fractions) : fractions_(fractions) {}

  Fractions at(const Eigen::Vector3d& x_in_lps, double volume) const;

 private:
  const Volume<Fractions>& fractions_;
};

}  // namespace mammotwin
