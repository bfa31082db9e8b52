#pragma once

#include <functional>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

struct HalfBallElements {
  int core = 4;   ///< along x and y in the core, even, at least 2; half as many along z
  int shell = 2;  ///< between core and skin, at least 1
};

/// A smooth map of the half ball |p| <= 1, p_z >= 0, that keeps p_z = 0 a plane, as a Hermite mesh:
/// a core block with five blocks of shell round it, so that no element has two faces on the skin.
/// Blocks have nodes of their own, tied along their faces (C0 there, C1 inside). The flat face is
/// labelled chest_wall, the round one skin.
MeshFile half_ball_mesh(const std::function<Eigen::Vector3d(const Eigen::Vector3d& p)>& map,
                        const HalfBallElements& elements);

}  // namespace mammotwin
