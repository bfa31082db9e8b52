#pragma once

#include <array>
#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// What a synthetic body is made of. All from `muscle` on lies behind the front of the muscle.
enum class Substance : std::uint8_t {
  air,
  skin,
  fat,
  fibroglandular,
  lesion,
  muscle,
  rib,
  lung,
  heart,
  liver
};
inline constexpr int num_substances = 10;

/// The materials of one voxel, in sample points: `parts` sum to TissueMap::parts_per_voxel.
struct VoxelMixture {
  std::array<std::uint8_t, num_substances> parts{};
  std::uint8_t lesion = 0;  ///< which lesion `parts[lesion]` belongs to, from 0

  std::uint8_t& operator[](Substance m) { return parts[static_cast<int>(m)]; }
  std::uint8_t operator[](Substance m) const { return parts[static_cast<int>(m)]; }
  /// Sample points behind the front of the muscle.
  int behind() const {
    int sum = 0;
    for (int m = static_cast<int>(Substance::muscle); m < num_substances; ++m) sum += parts[m];
    return sum;
  }
};

/// Materials on a grid in LPS.
struct TissueMap {
  Volume<VoxelMixture> mixtures;
  int parts_per_voxel = 1;
};

}  // namespace mammotwin
