#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/synthesize/chest.h"
#include "pipeline/synthesize/lattice_noise.h"

namespace mammotwin {

/// A mass: an ellipsoid with lobules.
class LesionShape {
 public:
  /// `diameter_mm`: of the ball of the ellipsoid's volume.
  LesionShape(const Eigen::Vector3d& centre, double diameter_mm, std::uint64_t seed, int number);

  bool contains(const Eigen::Vector3d& x) const;
  const Eigen::Vector3d& centre() const { return centre_; }
  double reach() const { return reach_; }  ///< no point is further from the centre [mm]

 private:
  Eigen::Vector3d centre_;
  Eigen::Matrix3d unit_from_offset_;
  double lobulation_, reach_;
  LatticeNoise lobules_;
};

/// Places `options.lesions` masses in the breast of `options.side`, off skin, wall and each other.
/// Throws std::invalid_argument where they find no room.
std::vector<LesionShape> place_lesions(const Chest& chest, const AnatomyOptions& options);

}  // namespace mammotwin
