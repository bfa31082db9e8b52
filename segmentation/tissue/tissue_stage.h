#pragma once

#include "segmentation/body/half_breast.h"
#include "segmentation/segment.h"
#include "segmentation/tissue/tissue_image.h"

namespace mammotwin {

/// Skin, fat and fibroglandular tissue of one half, around the lesions. Fills labels and fractions
/// of the result, its image, and the quality of skin and fat suppression.
void label_tissue(const HalfBreast& half, const TissueImage& scan,
                  const Volume<std::uint8_t>& lesions, bool fat_suppressed,
                  const SegmentOptions& options, SegmentResult& result);

}  // namespace mammotwin
