#include "segmentation/tissue/fraction_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

using Mask = Volume<std::uint8_t>;

constexpr double noise_block_mm = 3, noise_reach_mm = 10;
constexpr float darkest = -0.5F;  // below it a fraction is no noise about fat: clips, scars, air
constexpr float dead_zone = 1, widest_dead_zone = 0.15F;
constexpr double least_excess = 5;
constexpr double alike_voxels = 8;  // within a cube of two a side a restored image's noise is one

/// Mean square of the fractions below fat, as a field.
Volume<float> noise_square(const Volume<float>& fraction, const Mask& statistics) {
  auto square = fraction.like<float>(0);
  auto below = statistics.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < square.values.size(); ++v) {
    const float f = fraction.values[v];
    below.values[v] = statistics.values[v] && f < 0 && f > darkest;
    square.values[v] = f * f;
  }
  return smooth_field(square, below, noise_block_mm, noise_reach_mm);
}

/// Takes out the parts beyond a half that noise would give.
void take_out_specks(const std::vector<float>& noise, Volume<float>& fraction) {
  auto gland = fraction.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < gland.values.size(); ++v) gland.values[v] = fraction.values[v] > 0.5F;
  const Components parts = connected_components(gland);
  std::vector<double> excess(parts.sizes.size(), 0), square(parts.sizes.size(), 0);
  for (std::size_t v = 0; v < gland.values.size(); ++v) {
    excess[parts.ids.values[v]] += fraction.values[v];
    square[parts.ids.values[v]] += noise[v] * noise[v];
  }
  const auto is_noise = [&](std::size_t part) {
    const double size = static_cast<double>(parts.sizes[part]);
    const double of_mean = std::sqrt(square[part] / size / std::max(1.0, size / alike_voxels));
    return excess[part] / size < least_excess * of_mean;
  };
  std::vector<char> speck(parts.sizes.size(), 0);
  for (std::size_t part = 1; part < speck.size(); ++part) speck[part] = is_noise(part);
  for (std::size_t v = 0; v < gland.values.size(); ++v)
    if (speck[parts.ids.values[v]]) fraction.values[v] = 0;
}

}  // namespace

Volume<float> without_noise(Volume<float> fraction, const Mask& interior, const Mask& statistics) {
  const Volume<float> square = noise_square(fraction, statistics);
  std::vector<float> noise(fraction.values.size(), 0);
  for (int k = 0; k < fraction.size.z(); ++k)
    for (int j = 0; j < fraction.size.y(); ++j)
      for (int i = 0; i < fraction.size.x(); ++i) {
        const std::size_t v = fraction.offset(i, j, k);
        float& f = fraction.values[v];
        f = interior.values[v] ? std::min(f, 1.0F) : 0;
        if (!interior.values[v]) continue;
        noise[v] = std::sqrt(std::max(0.0F, interpolated(square, fraction.position(i, j, k))));
      }
  take_out_specks(noise, fraction);
  for (std::size_t v = 0; v < noise.size(); ++v) {
    const float dead = std::min(widest_dead_zone, dead_zone * noise[v]);
    float& f = fraction.values[v];
    f = std::clamp((f - dead) / (1 - 2 * dead), 0.0F, 1.0F);
  }
  return fraction;
}

}  // namespace mammotwin
