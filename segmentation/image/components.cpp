#include "segmentation/image/components.h"

#include <algorithm>

#include "segmentation/image/label_components.h"

namespace mammotwin {
std::int32_t Components::largest() const {
  if (sizes.size() < 2) return 0;
  return static_cast<std::int32_t>(std::max_element(sizes.begin() + 1, sizes.end()) -
                                   sizes.begin());
}

Components connected_components(const Volume<std::uint8_t>& mask) {
  Components parts;
  parts.ids = mask.like<std::int32_t>(0);
  parts.ids.values = label_components({mask.size.x(), mask.size.y(), mask.size.z()}, mask.values);
  parts.sizes = {0};
  for (const std::int32_t id : parts.ids.values) {
    if (id >= static_cast<std::int32_t>(parts.sizes.size())) parts.sizes.resize(id + 1, 0);
    ++parts.sizes[id];
  }
  return parts;
}

Volume<std::uint8_t> largest_component(const Volume<std::uint8_t>& mask) {
  const Components parts = connected_components(mask);
  const std::int32_t keep = parts.largest();
  auto out = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v)
    out.values[v] = keep > 0 && parts.ids.values[v] == keep;
  return out;
}

Volume<std::uint8_t> without_small_components(const Volume<std::uint8_t>& mask, double least_ml) {
  const Components parts = connected_components(mask);
  const double voxel_ml = mask.voxel_volume() / 1000;
  auto out = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v) {
    const std::int32_t id = parts.ids.values[v];
    out.values[v] = id > 0 && static_cast<double>(parts.sizes[id]) * voxel_ml >= least_ml;
  }
  return out;
}

}  // namespace mammotwin
