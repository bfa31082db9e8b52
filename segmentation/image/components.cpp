#include "segmentation/image/components.h"

#include <algorithm>

namespace mammotwin {
namespace {

/// Gives one part its number, from a seed on; returns its size.
std::size_t fill(const Volume<std::uint8_t>& mask, Volume<std::int32_t>& ids, std::size_t seed,
                 std::int32_t id, std::vector<std::size_t>& stack) {
  const std::size_t nx = mask.size.x(), nxy = nx * mask.size.y(), n = mask.values.size();
  std::size_t count = 0;
  const auto visit = [&](std::size_t v) {
    if (!mask.values[v] || ids.values[v]) return;
    ids.values[v] = id;
    stack.push_back(v);
  };
  visit(seed);
  while (!stack.empty()) {
    const std::size_t v = stack.back();
    stack.pop_back();
    ++count;
    const std::size_t x = v % nx, y = v % nxy / nx;
    if (x > 0) visit(v - 1);
    if (x + 1 < nx) visit(v + 1);
    if (y > 0) visit(v - nx);
    if (y + 1 < nxy / nx) visit(v + nx);
    if (v >= nxy) visit(v - nxy);
    if (v + nxy < n) visit(v + nxy);
  }
  return count;
}

}  // namespace

std::int32_t Components::largest() const {
  if (sizes.size() < 2) return 0;
  return static_cast<std::int32_t>(std::max_element(sizes.begin() + 1, sizes.end()) -
                                   sizes.begin());
}

Components connected_components(const Volume<std::uint8_t>& mask) {
  Components parts;
  parts.ids = mask.like<std::int32_t>(0);
  parts.sizes = {mask.values.size()};
  std::vector<std::size_t> stack;
  for (std::size_t v = 0; v < mask.values.size(); ++v) {
    if (!mask.values[v] || parts.ids.values[v]) continue;
    const auto id = static_cast<std::int32_t>(parts.sizes.size());
    parts.sizes.push_back(fill(mask, parts.ids, v, id, stack));
    parts.sizes[0] -= parts.sizes.back();
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

Volume<std::uint8_t> without_small_components(const Volume<std::uint8_t>& mask, std::size_t least) {
  const Components parts = connected_components(mask);
  auto out = mask.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v)
    out.values[v] = parts.ids.values[v] > 0 && parts.sizes[parts.ids.values[v]] >= least;
  return out;
}

}  // namespace mammotwin
