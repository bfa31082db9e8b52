#include "fitting/tissue/tissue_volumes.h"

#include <Eigen/LU>
#include <array>

#include "fitting/tissue/gauss_points.h"

namespace mammotwin {

namespace {

constexpr double mm3_in_ml = 1000;

void add(TissueVolumes& sum, const Fractions& f, double volume) {
  sum.fat += f.fat * volume / mm3_in_ml;
  sum.fibroglandular += f.fibroglandular * volume / mm3_in_ml;
  sum.lesion += f.lesion * volume / mm3_in_ml;
}

}  // namespace

TissueVolumes tissue_in_mesh(const HermiteMesh& mesh, const FractionSampler& sample) {
  TissueVolumes sum;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int q = 0; q < 64; ++q) {
      const int i = q % 4, j = q / 4 % 4, k = q / 16;
      const MeshPoint p{e, {gauss_points[i], gauss_points[j], gauss_points[k]}};
      const double volume =
          gauss_weights[i] * gauss_weights[j] * gauss_weights[k] * mesh.jacobian(p).determinant();
      add(sum, sample(mesh.position(p), volume), volume);
    }
  return sum;
}

TissueVolumes tissue_in_voxels(const Segmentation& s) {
  TissueVolumes sum;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int i = 0; i < s.labels.size.x(); ++i) {
      if (!s.region.contains(s.labels.position(i, 0, k))) continue;
      for (int j = 0; j < s.labels.size.y() && s.labels(i, j, k) != label::muscle; ++j)
        if (label::is_breast(s.labels(i, j, k)))
          add(sum, s.fractions(i, j, k), s.labels.voxel_volume());
    }
  return sum;
}

}  // namespace mammotwin
