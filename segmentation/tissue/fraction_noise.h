#pragma once

#include <cstdint>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Fractions of gland as measured, not cut to [0, 1], without what noise alone would show, and cut.
///
/// Noise is what lies below pure fat: its root mean square s over fat within some 10 mm (on both
/// sides of fat it is alike, above it gland lies, too). Cut at 0, noise about fat would leave 0.4 s
/// everywhere: for s = 0.1 a twenty-fifth of the breast would count as gland. So fractions within s
/// of fat are fat, those as near to gland are gland, and between them they are spread again, which
/// leaves 0.08 s; twice as wide, it took true part volumes from label maps (0.03 of Dice). Parts
/// beyond a half whose mean is not five times what noise gives to the mean of as many voxels (those
/// in a cube of two a side count as one: restoring makes their noise alike) are fat. `statistics`:
/// where fat may be measured.
Volume<float> without_noise(Volume<float> fraction, const Volume<std::uint8_t>& interior,
                            const Volume<std::uint8_t>& statistics);

}  // namespace mammotwin
