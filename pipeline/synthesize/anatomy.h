#pragma once

#include <array>
#include <vector>

#include "pipeline/synthesize/chest.h"
#include "pipeline/synthesize/gland_field.h"
#include "pipeline/synthesize/lesion_shape.h"
#include "pipeline/synthesize/tissue_map.h"

namespace mammotwin {

/// A synthetic patient's body as implicit functions; nothing of it depends on a voxel grid.
class Anatomy {
 public:
  /// Throws std::invalid_argument where the options cannot be met.
  explicit Anatomy(const AnatomyOptions& options);

  const AnatomyOptions& options() const { return options_; }
  const Chest& chest() const { return chest_; }
  const std::vector<LesionShape>& lesions() const { return lesions_; }

  /// Materials of cubic voxels from `samples`^3 points in each, over a field of view that holds
  /// both breasts, the sides of the chest and the front of the thorax.
  TissueMap sample(double voxel_mm, int samples) const;

  /// One of those voxels.
  VoxelMixture sample_voxel(const Eigen::Vector3d& centre, double voxel_mm, int samples) const;

 private:
  void add_sample(VoxelMixture& mixture, const Eigen::Vector3d& x, double outside, double wall,
                  Substance behind) const;

  AnatomyOptions options_;
  Chest chest_;
  std::array<GlandField, 2> glands_;  ///< by Side
  std::vector<LesionShape> lesions_;
};

}  // namespace mammotwin
