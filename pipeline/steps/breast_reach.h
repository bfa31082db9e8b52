#pragma once

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// How far a breast reaches along a direction [mm].
struct BreastReach {
  double wall;  ///< its chest wall, at most
  double tip;   ///< skin and cut faces, at most
};

BreastReach breast_reach(const MeshFile& mesh, const Eigen::Vector3d& depth);

}  // namespace mammotwin
