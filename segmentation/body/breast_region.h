#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A piece of muscle smaller than this [ml] is a vessel or noise.
inline constexpr double least_muscle_ml = 2;

/// The rectangle in the coronal plane that bounds one breast, from labels as in segmentation.h, of
/// both breasts or of one half of the body.
///
/// A column runs from front to back at one (x, z). Its tissue reaches from the skin to the first
/// muscle, or to the last labelled voxel where there is no muscle. The rectangle is bounded
///   medially   by the valley of the skin between the two apices; with one breast in the labels,
///              by the end of the labels;
///   elsewhere  15 mm beyond the part around the apex where tissue is thicker than 0.35 of the
///              apex column;
/// then pulled in until every column has 5 mm of tissue (8 mm in the lateral edge's), in the order
/// that takes less tissue away, then pushed out to hold every lesion of that side.
///
/// Throws std::runtime_error if that side holds no breast that stands out from the chest.
BreastRegion find_breast_region(const Volume<std::uint8_t>& labels, Side side);

}  // namespace mammotwin
