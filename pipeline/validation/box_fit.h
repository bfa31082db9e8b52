#pragma once

#include <functional>

#include "fitting/slab/slab.h"

namespace mammotwin {

/// Box in front of y = 0, ξ₁ along x, ξ₂ along z, ξ₃ towards −y, whose front is to become a skin.
inline constexpr double kBoxSide_mm = 100, kBoxDepth_mm = 40;
std::vector<HermiteMesh::Node> box_nodes(const Slab& slab);

/// Place [mm] of a skin's point (u, v) in [0,1]².
using Skin = std::function<Eigen::Vector3d(double u, double v)>;

/// A Gaussian bell, 30 mm high and 22 mm wide, on the box's front, off its middle.
Eigen::Vector3d bell_on_box(double u, double v);

struct BoxFit {
  int points_per_side = 65;
  int steps = 30;
  /// Levenberg and Marquardt's damping at least, of the Hessian's diagonal: next to nothing else
  /// holds the mesh from sliding farther than the planes that stand for the skin are true. It does
  /// not move where the steps end. 0: Powell's dog leg, undamped.
  double hold = 1e-3;
};

/// Moves the nodes to least distance of points of the skin to the mesh. Smoothing and shape energy
/// weigh next to nothing: they decide only what the points leave open. Returns the root mean square
/// distance that is left [mm].
double fit_box(const Slab& slab, const Skin& skin, const BoxFit& options,
               std::vector<HermiteMesh::Node>& nodes);

}  // namespace mammotwin
