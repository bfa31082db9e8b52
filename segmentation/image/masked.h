#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/image/order_statistics.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// The values of an image in a mask, in the image's order.
inline std::vector<float> values_in(const Volume<float>& image, const Volume<std::uint8_t>& mask) {
  std::vector<float> values;
  for (std::size_t v = 0; v < mask.values.size(); ++v)
    if (mask.values[v]) values.push_back(image.values[v]);
  return values;
}

/// Their median; 0 where there are fewer than `least` of them.
inline double median_in(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                        std::size_t least = 1) {
  std::vector<float> values = values_in(image, mask);
  return values.size() < least || values.empty() ? 0 : median(values);
}

}  // namespace mammotwin
