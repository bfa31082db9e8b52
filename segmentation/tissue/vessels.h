#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"
#include "segmentation/tissue/fibroglandular.h"

namespace mammotwin {

/// Relative enhancement from which on a voxel is a vessel's or a lesion's: gland takes up less.
inline constexpr float vessel_uptake = 1;

/// Vessels full of contrast agent: tubes (tube_response at two scales) longer than 15 mm, with
/// 1.5 mm around. With `enhancement` (relative_enhancement, on the grid of `split`) it at least
/// doubles brightness in them. Without, the image is fat-suppressed: strands of gland are as thin
/// and as long, so a vessel is brighter than gland where it runs through fat, and the brighter the
/// more gland lies within some 10 mm; before agent vessels are as bright as strands, and none is
/// found.
Volume<std::uint8_t> find_vessels(const TissueSplit& split, const Volume<std::uint8_t>& interior,
                                  const Volume<float>& enhancement);

/// Takes what `vessels` hold as what lies within some 3 mm of them in the `interior`: fat where
/// they run through fat, gland where they run through gland.
void take_as_surroundings(const Volume<std::uint8_t>& vessels, const Volume<std::uint8_t>& interior,
                          TissueSplit& split);

/// Volume of a mask in the region [ml].
double volume_in(const BreastRegion& region, const Volume<std::uint8_t>& mask);

}  // namespace mammotwin
