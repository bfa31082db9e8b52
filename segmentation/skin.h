#pragma once

#include <cstdint>

#include "segmentation/volume.h"

namespace mammotwin {

/// Thickness of the skin and the range that it may have [mm].
struct SkinThickness {
  double thickness = 0, low = 0, high = 0;
  double misfit = 0;  ///< root mean square of the fit over the brightness of fat
};

/// Thickest slab tried [mm]: fat must show below it in the 5.5 mm that are looked at.
inline constexpr double thickest_measured_skin_mm = 5;

/// Fits a blurred slab (air, skin, fat) to the median profile along the depth below the skin.
///
/// The image's own blur is not known: a Gaussian of 0.55 voxels is assumed, and the range is what
/// 1.3 and 0.75 times that blur would give (study of segmentation, section 5: at the resolution
/// of a breast MRI skin under 2 mm is read by its blur). `where`: voxels near the breast's skin
/// that may be used, to at least 5.5 mm deep and 3 mm outside.
SkinThickness measure_skin(const Volume<float>& image, const Volume<std::uint8_t>& body,
                           const Volume<std::uint8_t>& where);

}  // namespace mammotwin
