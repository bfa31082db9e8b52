#pragma once

#include "fitting/slab/slab.h"

namespace mammotwin {

/// A slab's skin (ξ₃ = 1 of its last layer) as one C¹ surface over [0, n₁] x [0, n₂].
class SkinPatches {
 public:
  using Coordinates = Eigen::Vector2d;

  SkinPatches(const Slab& slab, const HermiteMesh& mesh);

  struct Point {
    Eigen::Vector3d x, by_s, by_t;  ///< position and tangents [mm]
    Eigen::Vector3d normal() const;
  };
  Point at(const Coordinates& st) const;

  /// A nearest point of the surface, descending from `start`. With `held` 0 or 1 that
  /// coordinate keeps its value: the nearest point of an edge.
  Coordinates nearest(const Eigen::Vector3d& x, Coordinates start, int held = -1) const;

  /// The element and ξ of a point of the skin.
  MeshPoint mesh_point(const Coordinates& st) const;

  const Eigen::Vector3i& elements() const { return slab_.elements; }

 private:
  Slab slab_;
  std::vector<Eigen::Matrix<double, 3, 16>> patches_;  ///< Bezier points, column i + 4j
};

}  // namespace mammotwin
