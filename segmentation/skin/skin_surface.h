#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// The surface of the skin between the voxels.
struct SkinSurface {
  Volume<std::uint8_t> body;  ///< the voxels of which more than half is body
  Volume<float> depth;        ///< below the surface [mm], negative outside, right within 5.5 mm
};

/// Moves the surface of a mask to where the skin begins, by at most about two voxels.
///
/// Over and over: the profile of brightness along the depth is taken over all skin in `where`, and
/// a slab fitted to it says where in it the skin begins. Around every point the image is then
/// compared with that profile P(d), as gain (P + shift P'), by least squares for the gain over 12
/// mm and the shift over 1.5 (Gaussian); the shift is by how much the surface lies elsewhere there
/// (Lucas and Kanade, IJCAI 1981, 674-679, along one direction). Skin dark or bright, thin or
/// thick, more or less shaded is so treated alike, and noise averaged along the surface.
///
/// `image`: bias corrected, not denoised.
SkinSurface find_skin_surface(const Volume<float>& image, const Volume<std::uint8_t>& body,
                              const Volume<std::uint8_t>& where);

}  // namespace mammotwin
