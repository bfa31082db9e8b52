#pragma once

#include <optional>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// What a mammogram shows beside the breast.
struct AirLevel {
  float grey = 0;       ///< median of what is dark
  float spread = 0;     ///< standard deviation about it, from the median absolute one
  float threshold = 0;  ///< above it is skin
};

/// The air of an image whose dark part lies above `floor`, by what it is in this image: the median
/// below Otsu's threshold and its spread. Where that part is too wide for air (bright muscle, and
/// more dim breast than air below the threshold), it is split again. Skin is nine spreads brighter,
/// and `least_share` of the range of greys. Throws std::runtime_error where nothing is dark.
AirLevel air_level(const MammogramImage& image, float floor, double least_share);

/// White lines along the image's edges, as film readers and collimators leave them, show what lies
/// beside them: a breast goes on to the edge, and so does air. On the image as stored: shrunk, thin
/// lines are white no more.
void paint_over_borders(MammogramImage& image);

/// The breast: 1, else 0; the largest bright region that lies at the left or right edge, without
/// white borders, labels and what is thinner than 2 mm. Where the darkest grey is the frame of an
/// exposed field, whose grey air would make all of the field a breast, air is looked for again
/// above it.
///
/// Throws std::runtime_error, with what to do, where no region is like a breast: it fills less than
/// 3 % or more than 90 % of the image, or its skin lies on the image's far edge.
///
/// `least_share`: how much brighter than air skin must be at least; the smaller one follows nipples
/// that are fainter than any skin, and haloes.
inline constexpr double kSkinShare = 0.006, kFaintShare = 0.0022;
MammogramImage breast_mask(const MammogramImage& image, double pixel_mm,
                           double least_share = kSkinShare);

}  // namespace mammotwin
