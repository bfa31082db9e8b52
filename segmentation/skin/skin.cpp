#include "segmentation/skin/skin.h"

#include <algorithm>
#include <cmath>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double bin_mm = 0.25, outermost_mm = -3, innermost_mm = 5.5;
constexpr std::size_t least_in_bin = 50;

}  // namespace

SkinProfile skin_profile(const Volume<float>& image, const Volume<float>& depth,
                         const Volume<std::uint8_t>& where, double innermost) {
  const int bins = static_cast<int>((innermost - outermost_mm) / bin_mm);
  std::vector<std::vector<float>> samples(bins);
  for (std::size_t v = 0; v < image.values.size(); ++v) {
    if (!where.values[v]) continue;
    const int bin = static_cast<int>(std::floor((depth.values[v] - outermost_mm) / bin_mm));
    if (bin >= 0 && bin < bins) samples[bin].push_back(image.values[v]);
  }
  SkinProfile profile;
  for (int b = 0; b < bins; ++b) {
    if (samples[b].size() < least_in_bin) continue;
    profile.depth.push_back(outermost_mm + (b + 0.5) * bin_mm);
    profile.value.push_back(median(samples[b]));
  }
  return profile;
}

SkinProfile without_noise(SkinProfile profile) {
  constexpr double air_mm = 0.75;  // of the 3 mm outside, beyond the skin's blur
  double sum = 0;
  int count = 0;
  for (std::size_t b = 0; b < profile.depth.size() && profile.depth[b] < outermost_mm + air_mm; ++b)
    sum += profile.value[b], ++count;
  const double noise = count > 0 ? sum / count : 0;
  for (double& value : profile.value)
    value = std::sqrt(std::max(0.0, value * value - noise * noise));
  return profile;
}

SkinSlab measure_skin(const Volume<float>& image, const Volume<float>& depth,
                      const Volume<std::uint8_t>& where) {
  return fit_skin_slab(without_noise(skin_profile(image, depth, where, innermost_mm)),
                       std::cbrt(image.voxel_volume()));
}

}  // namespace mammotwin
