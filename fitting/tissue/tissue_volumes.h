#pragma once

#include <functional>

#include "fitting/mesh/hermite_mesh.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Volumes of the three tissues [ml].
struct TissueVolumes {
  double fat = 0, fibroglandular = 0, lesion = 0;
  double total() const { return fat + fibroglandular + lesion; }
};

/// Fractions of a cell of `volume` [mm³] around a position in LPS [mm].
using FractionSampler = std::function<Fractions(const Eigen::Vector3d& x, double volume)>;

/// What the mesh's 4³ Gauss points an element hold, each with the fractions of its cell.
TissueVolumes tissue_in_mesh(const HermiteMesh& mesh, const FractionSampler& sample);

/// What the voxels of the region in front of the muscle hold.
TissueVolumes tissue_in_voxels(const Segmentation& segmentation);

}  // namespace mammotwin
