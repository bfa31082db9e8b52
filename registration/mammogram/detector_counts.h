#pragma once

#include <optional>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// How a FOR PROCESSING image stores what the detector saw.
struct CountsEncoding {
  bool logarithmic = false;              ///< (0028,1040) PixelIntensityRelationship is LOG
  std::optional<bool> brighter_is_more;  ///< (0028,1041): 1, more X-rays are higher values; -1
  std::optional<double> full_scale;      ///< largest value that can be stored
};

/// Turns detector counts into what was absorbed, dense tissue bright: the logarithm of the loss
/// against the open field (99.9th percentile: a hot pixel is no air), whichever way it was stored.
/// Where no sign is said: the one by which the image's left and right part look most like a breast
/// and air, which varies little and absorbs less.
///
/// Lines along the edges that a collimator covers are given the values of the nearest line that is
/// exposed, and `field` says which are. The heel of the beam, a
/// parabola through air's values, is taken out.
void absorption_from_counts(MammogramImage& image, const CountsEncoding& encoding);

}  // namespace mammotwin
