#pragma once

#include <optional>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// How a FOR PROCESSING image stores what the detector saw.
struct CountsEncoding {
  bool logarithmic = false;              ///< (0028,1040) PixelIntensityRelationship is LOG
  std::optional<bool> brighter_is_more;  ///< (0028,1041): 1, more X-rays are higher values; -1
};

/// Turns detector counts into what was absorbed, dense tissue bright: the logarithm of the loss
/// against the 99.9th percentile (a hot pixel is no air), whichever way it was stored. Where no
/// sign is said, air is what varies less in the image's left or right part. White borders become
/// dark (nothing reaches what is collimated), and the heel of the beam, the plane through air's
/// values, is taken out.
void absorption_from_counts(MammogramImage& image, const CountsEncoding& encoding);

}  // namespace mammotwin
