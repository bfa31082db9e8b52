#pragma once

#include "fitting/mesh/mesh_file.h"
#include "fitting/slab/grading.h"
#include "fitting/surface/flatten.h"
#include "fitting/surface/wall_height.h"

namespace mammotwin {

/// A regular grid of elements over the breast: ξ₁ with x, ξ₂ with z, ξ₃ from chest wall to skin.
/// Global coordinates u, v, w in [0,1] run through all elements of a direction.
struct Slab {
  Eigen::Vector3i elements;
  std::array<Grading, 2> grading = {};  ///< along x and z

  /// Where a point of the flattened skin lies in the slab.
  Eigen::Vector2d graded(const Eigen::Vector2d& uv) const {
    return {grading[0](uv.x()), grading[1](uv.y())};
  }

  int num_nodes() const { return (elements.array() + 1).prod(); }
  int node(int i, int j, int k) const {
    return i + (elements.x() + 1) * (j + (elements.y() + 1) * k);
  }
  int element(int i, int j, int k) const { return i + elements.x() * (j + elements.y() * k); }
};

/// Which nodal parameters are held: side faces lie in the region's planes, so that there the
/// normal coordinate's value and its derivatives within the face are fixed. Entry 3d + component.
using HeldParameters = std::vector<std::array<bool, 24>>;
HeldParameters held_parameters(const Slab& slab);

/// Straight rays from the wall to the flattened skin, both as least-squares bicubic Hermite
/// surfaces. It may fold; side faces lie exactly in the region's planes.
HermiteMesh straight_start(const Slab& slab, const TriangleSurface& skin, const FlatSkin& flat,
                           const HeightField& wall, const BreastRegion& region);

/// Skin on ξ₃ = 1, chest wall on ξ₃ = 0, cut faces on the sides.
std::vector<FaceLabels> slab_faces(const Slab& slab);

}  // namespace mammotwin
