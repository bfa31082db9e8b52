#pragma once

#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/segmentation.h"
#include "segmentation/shading/half_images.h"
#include "segmentation/skin/skin_stage.h"
#include "segmentation/tissue/fibroglandular.h"
#include "segmentation/tissue/tissue_image.h"

namespace mammotwin {

/// Where fat and fibroglandular tissue are told apart, and where their brightness is measured.
struct TissueMasks {
  Volume<std::uint8_t> interior;    ///< the breast without skin, lesions and their blur
  Volume<std::uint8_t> statistics;  ///< away from skin, wall, lesions and vessels
};

/// `lesions`: 0 outside them. `skin_mm`: the skin's thickness.
TissueMasks tissue_masks(const HalfBreast& half, const Volume<float>& enhancement,
                         const Volume<std::uint8_t>& lesions, double skin_mm);

/// `image` with `tissue`, restored, in its place within `interior`.
Volume<float> restored_within(const Volume<std::uint8_t>& interior, const Volume<float>& image,
                              const TissueImage& tissue);

/// Labels and fractions of one half from what was found in it. `skin_mm`: the skin's thickness.
Segmentation labelled(const HalfBreast& half, const Volume<float>& skin_depth, double skin_mm,
                      const Volume<std::uint8_t>& lesions, const TissueSplit& split);

/// `image` with the bias taken out that `split` took out of `restored`.
Volume<float> corrected_like(const TissueSplit& split, const Volume<float>& restored,
                             Volume<float> image);

}  // namespace mammotwin
