#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Euclidean distance [mm] from each voxel centre to the nearest voxel centre of the mask; a large
/// number where the mask is empty. Exact, after Felzenszwalb and Huttenlocher, Theory of Computing
/// 8 (2012), 415-428.
Volume<float> distance_to(const Volume<std::uint8_t>& mask);

/// Voxels within `radius` mm of the mask.
Volume<std::uint8_t> dilated(const Volume<std::uint8_t>& mask, double radius);
/// Voxels of the mask farther than `radius` mm from any voxel outside it. The image's border does
/// not erode.
Volume<std::uint8_t> eroded(const Volume<std::uint8_t>& mask, double radius);
/// Eroded, then dilated: without parts thinner than twice the radius.
Volume<std::uint8_t> opened(const Volume<std::uint8_t>& mask, double radius);
/// Dilated, then eroded: with gaps narrower than twice the radius filled.
Volume<std::uint8_t> closed(const Volume<std::uint8_t>& mask, double radius);

}  // namespace mammotwin
