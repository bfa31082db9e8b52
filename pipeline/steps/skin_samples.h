#pragma once

#include <vector>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// A piece of skin.
struct SkinSample {
  Eigen::Vector3d x, outward;  ///< [mm], unit
  double area;                 ///< [mm²]
};

/// All skin of a mesh, in `per_side` x `per_side` pieces a face.
std::vector<SkinSample> skin_samples(const MeshFile& mesh, int per_side);

}  // namespace mammotwin
