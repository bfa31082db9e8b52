#pragma once

#include <cstdint>

#include "segmentation/chest_wall/half_breast.h"

namespace mammotwin {

/// Muscle that stands in front of a wall found: the free edge of the pectoral muscle in the axilla,
/// slips of serratus on the flank, the abdomen's straight muscle where the wall went behind it. One
/// radius for each ray finds the deeper of two muscles with fat between them, and what stands in
/// front passes for gland.
///
/// Of what passes for gland (`gland_fraction` over a half), cores thicker than vessels that lie
/// wholly near the wall, begin at it and are as bright as what lies behind it; with what lies
/// between them and the wall on its rays. `image`: bias corrected, fat at 1.
Volume<std::uint8_t> muscle_before_wall(const HalfBreast& half, const PectoralWall& wall,
                                        const Volume<float>& gland_fraction,
                                        const Volume<float>& image);

}  // namespace mammotwin
