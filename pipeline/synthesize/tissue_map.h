#pragma once

#include <array>
#include <cstdint>

#include "segmentation/volume.h"

namespace mammotwin {

/// What a synthetic body is made of. All from `muscle` on lies behind the front of the muscle.
enum class Material : std::uint8_t {
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
inline constexpr int num_materials = 10;

/// The materials of one voxel, in sample points: `parts` sum to TissueMap::parts_per_voxel.
struct Mixture {
  std::array<std::uint8_t, num_materials> parts{};
  std::uint8_t lesion = 0;  ///< which lesion `parts[lesion]` belongs to, from 0

  std::uint8_t& operator[](Material m) { return parts[static_cast<int>(m)]; }
  std::uint8_t operator[](Material m) const { return parts[static_cast<int>(m)]; }
  /// Sample points behind the front of the muscle.
  int behind() const {
    int sum = 0;
    for (int m = static_cast<int>(Material::muscle); m < num_materials; ++m) sum += parts[m];
    return sum;
  }
};

/// Materials on a grid in LPS.
struct TissueMap {
  Volume<Mixture> mixtures;
  int parts_per_voxel = 1;
};

}  // namespace mammotwin
