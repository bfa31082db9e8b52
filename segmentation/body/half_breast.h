#pragma once

#include "segmentation/chest_wall/wall_stage.h"
#include "segmentation/skin/skin_slab.h"

namespace mammotwin {

/// One side's part of the image: from the midline out, from the air in front to a plane 100 mm
/// behind the skin between the breasts.
struct HalfBreast {
  Side side = Side::left;
  Volume<float> image;                ///< bias corrected, denoised, fat at 1
  Volume<float> scan;                 ///< the same, not denoised
  Volume<float> pre;                  ///< like `scan`, before contrast agent; may be empty
  std::optional<PreMatch> pre_match;  ///< of `pre`
  Volume<float> noise;                ///< standard deviation in either; 0 where it is not known
  double noise_spread = 1;            ///< BodyStage's noise at a distance over `noise`
  Volume<float> widely_corrected;     ///< by the 60 mm part of the bias only, its median fat at 1
  Volume<float> enhancement;          ///< relative; empty without `pre`
  Volume<std::uint8_t> body;
  Volume<std::uint8_t> inside;  ///< body in front of the chest wall
  Volume<float> depth;          ///< below the skin [mm]
  Volume<float> skin_depth;     ///< the same between the voxels, right up to 5.5 mm
  SkinSlab skin;                ///< its thickness
  Volume<float> above_wall;     ///< distance to what lies behind the chest wall [mm]
};

/// Cuts out one side.
HalfBreast cut_half(const BodyStage& body, const WallStage& wall, Side side);

/// Refines the bias: of the flank by its fat, then by N4 in the breast, away from skin and wall.
void correct_shading(const BreastFrame& frame, HalfBreast& half);

}  // namespace mammotwin
