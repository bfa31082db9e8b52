#include "registration/view/wall_samples.h"

#include "solver/element/face.h"

namespace mammotwin {

std::vector<WallSample> wall_samples(const MeshFile& mesh, int per_side) {
  std::vector<WallSample> samples;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      if (mesh.faces[e][face] != FaceLabel::chest_wall) continue;
      for (int k = 0; k < per_side * per_side; ++k)
        samples.push_back({{e, point_on_face(face, (k % per_side + 0.5) / per_side,
                                             (k / per_side + 0.5) / per_side)},
                           face});
    }
  return samples;
}

}  // namespace mammotwin
