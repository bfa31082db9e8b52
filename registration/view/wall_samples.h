#pragma once

#include <vector>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

struct WallSample {
  MeshPoint at;
  int face;  ///< of the element, as in FaceLabels
};

/// per_side x per_side points of each face that is labelled chest wall, evenly in ξ and none on its
/// rim.
std::vector<WallSample> wall_samples(const MeshFile& mesh, int per_side);

}  // namespace mammotwin
