#pragma once

#include <cstdint>

#include "segmentation/volume.h"

namespace mammotwin {

/// Two tissues told apart by brightness, inside `interior`.
struct TissueSplit {
  double fat = 1, gland = 1;     ///< brightness of pure tissue, in the corrected image
  Volume<float> corrected;       ///< the image with the remaining bias of fat taken out, fat at 1
  Volume<float> gland_fraction;  ///< (I - fat) / (gland - fat), cut to [0, 1]; 0 outside
};

/// Starts from Otsu's threshold, erodes both classes by a voxel so that partial volume leaves
/// their statistics, refits the bias on eroded fat (10 mm), and takes the medians of eroded fat
/// and eroded gland as pure tissue (study of segmentation, section 4: Dice 0.88 and 0.94, where
/// mixture models stay at 0.84 and 0.91). `statistics` is the part of the interior that may enter
/// them: away from skin, wall and lesions.
TissueSplit split_tissue(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                         const Volume<std::uint8_t>& statistics, bool fat_suppressed);

}  // namespace mammotwin
