#pragma once

#include "segmentation/body/breast_frame.h"
#include "segmentation/skin/skin_slab.h"
#include "segmentation/skin/skin_surface.h"

namespace mammotwin {

/// The skin of one half of the body.
struct SkinStage {
  SkinSurface surface;
  SkinSlab slab;  ///< thickness 0: not measured
};

/// Finds where the skin begins, and how thick it is where the breast hangs free. `image`: bias
/// corrected, not denoised.
SkinStage find_skin(const Volume<float>& image, const Volume<std::uint8_t>& body,
                    const BreastFrame& frame);

}  // namespace mammotwin
