#pragma once

#include <cstdint>

#include "segmentation/body/breast_frame.h"
#include "segmentation/chest_wall/pectoral_wall.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// The shape of one side: from the midline out, from the air in front to a plane 100 mm behind the
/// skin between the breasts.
struct HalfBreast {
  Side side = Side::left;
  Volume<std::uint8_t> body;
  Volume<std::uint8_t> inside;  ///< body in front of the chest wall
  Volume<float> depth;          ///< below the skin [mm], of voxels
  Volume<float> above_wall;     ///< distance to what lies behind the chest wall [mm]
};

/// The voxels of one side.
VoxelBox side_box(const Volume<float>& image, const BreastFrame& frame, Side side);

/// What of a body lies in front of the wall, and where in it.
HalfBreast half_breast(const Volume<std::uint8_t>& body, const PectoralWall& wall, Side side);

/// The breast 4 mm below the skin and 2 mm in front of the wall: what lies there is mixed with
/// neither, and its brightness tells the bias and the tissues (study, section 4).
Volume<std::uint8_t> pure_interior(const HalfBreast& half);

}  // namespace mammotwin
