#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/synthesize/chest.h"

namespace mammotwin {

/// A piece of duct or lobe: a rounded cone from `a` to `b` [mm].
struct Duct {
  Eigen::Vector3d a, b;
  double radius_a = 1, radius_b = 1;  ///< [mm]

  double distance(const Eigen::Vector3d& x) const;  ///< to its surface, negative inside
};

/// Ducts that fan back from the nipple and branch towards lobules scattered through the breast.
/// Lobules, nearest to the nipple first, join the tree where detour and new length together are
/// least (Cuntz, Forstner, Borst, Hausser: One rule to grow them all, PLoS Comput Biol 2010,
/// eq. 1, there for dendrites).
std::vector<Duct> grow_ducts(const Chest& chest, Side side, std::uint64_t seed);

}  // namespace mammotwin
