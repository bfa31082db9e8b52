#include "segmentation/lesion/lesion_region.h"

#include <algorithm>

#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"

namespace mammotwin {

using Mask = Volume<std::uint8_t>;

std::size_t count(const Mask& mask) {
  return static_cast<std::size_t>(std::count(mask.values.begin(), mask.values.end(), 1));
}

Volume<float> inner_distance(const Mask& mask) {
  auto outside = mask;
  for (std::uint8_t& value : outside.values) value = !value;
  return distance_to(outside);
}

double opening_of(const FoundLesion& lesion) {
  constexpr double share = 0.5;  // of the inscribed radius
  return std::min(share * lesion.inscribed_mm, most_opening_mm);
}

LesionRegion::LesionRegion(const Mask& lesion, const Mask& may)
    : mask(lesion), allowed(may), depth(inner_distance(lesion)), away(distance_to(lesion)) {}

double LesionRegion::brightness(const Volume<float>& image, double opening_mm) const {
  return median_in(
      image, where(mask, [&](const auto&, std::size_t v) { return depth.values[v] > opening_mm; }));
}

std::optional<double> LesionRegion::background(const Volume<float>& image) const {
  const Mask shell = where(mask, [&](const auto&, std::size_t v) {
    return allowed.values[v] && away.values[v] > shell_from_mm && away.values[v] < shell_to_mm;
  });
  if (count(shell) == 0) return std::nullopt;
  return median_in(image, shell);
}

}  // namespace mammotwin
