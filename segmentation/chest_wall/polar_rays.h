#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segmentation/chest_wall/pectoral_wall.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// The image along the rays of a PectoralWall's grid, sampled outwards every millimetre.
struct PolarRays {
  static constexpr int depths = 210;               ///< samples of a ray
  static constexpr double least_radius_mm = 30;    ///< of the first sample
  static constexpr float least_intensity = 0.02F;  ///< no sample is darker, as noise can leave none

  int rows = 0, angles = 0;
  std::vector<float> intensity;  ///< fat = 1; angles after depths, rows last
  std::vector<int> exit;         ///< of each ray: first sample outside the body

  const float* ray(std::size_t n) const { return &intensity[n * depths]; }
};

/// Mean of the samples low to high - 1 of a ray; of the nearest one where there are none.
double mean_along(const float* ray, int low, int high);

PolarRays cast_rays(const Volume<float>& image, const Volume<std::uint8_t>& body,
                    const PectoralWall& grid);

}  // namespace mammotwin
