#pragma once

#include "segmentation/chest_wall/wall_stage.h"
#include "segmentation/contrast_agent/before_agent.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// The images of one side on one grid, bias corrected, fat at 1.
struct HalfImages {
  Volume<float> denoised;
  Volume<float> noisy;        ///< the same, not denoised
  Volume<float> noise;        ///< standard deviation in either; 0 where it is not known
  Volume<float> pre;          ///< like `noisy`, before contrast agent; empty where there is none
  Volume<float> enhancement;  ///< relative; empty without `pre`
};

/// Cuts one side out, with the coarse bias correction that the wall was found in. The wall itself
/// was found in the noisy image: the filter blurs the faint edge of muscle far from the coil.
HalfImages cut_images(const BodyStage& body, const BeforeAgent& before, const WallStage& wall,
                      const VoxelBox& box);

}  // namespace mammotwin
