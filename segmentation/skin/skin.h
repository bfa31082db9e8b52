#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/skin/skin_slab.h"

namespace mammotwin {

/// Median brightness along the depth below the skin, over the voxels of `where`, from 3 mm outside
/// to `innermost_mm`.
SkinProfile skin_profile(const Volume<float>& image, const Volume<float>& depth,
                         const Volume<std::uint8_t>& where, double innermost_mm);

/// The noise of air, which the outermost values show, taken off as it adds to a magnitude: by
/// squares.
SkinProfile without_noise(SkinProfile profile);

/// The skin's thickness from that profile to 5.5 mm deep. `depth` as of `signed_depth`, its surface
/// found between the voxels (`find_skin_surface`): the voxels of a mask blur and shift it. `where`:
/// voxels near the breast's skin that may be used.
SkinSlab measure_skin(const Volume<float>& image, const Volume<float>& depth,
                      const Volume<std::uint8_t>& where);

}  // namespace mammotwin
