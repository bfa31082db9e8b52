#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Two tissues told apart by brightness, inside `interior`.
struct TissueSplit {
  double gland = 1;              ///< brightness of pure gland in the corrected image, of fat 1
  Volume<float> corrected;       ///< the image with the remaining bias taken out
  Volume<float> gland_fraction;  ///< (I - fat) / (gland - fat) without_noise; 0 outside
};

/// Starts from Otsu's threshold, erodes both classes by a voxel so that partial volume leaves
/// their statistics, and takes the medians of eroded fat and eroded gland as pure tissue (study of
/// segmentation, section 4: Dice 0.88 and 0.94, where mixture models stay at 0.84 and 0.91). The
/// bias is refitted on what is within a fifth of either (10 mm). What is over 2.5 times as bright
/// as fat is a vessel or a lesion and does not count for gland. `statistics` is the part of the
/// interior that may enter them: away from skin, wall and lesions.
TissueSplit split_tissue(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                         const Volume<std::uint8_t>& statistics, bool fat_suppressed);

}  // namespace mammotwin
