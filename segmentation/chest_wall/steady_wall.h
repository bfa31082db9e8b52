#pragma once

#include <vector>

#include "segmentation/chest_wall/wall_patch.h"

namespace mammotwin {

/// Where the wall of one side moves by more than 5 mm when it is looked for a little otherwise.
struct WallFlips {
  double share = 0;      ///< of the wall in front of that side
  double median_mm = 0;  ///< distance between the outermost and the deepest of the walls there
  WallPatch patch;       ///< the largest piece of the wall where they differ
};

/// Each ray takes the middle one of the walls found, all on one grid: where one of three has gone
/// to another edge, the other two decide, so that what is known only roughly beforehand (the usual
/// place of the wall, how bright muscle is) does not.
PectoralWall middle_wall(const std::vector<PectoralWall>& walls);

/// Where they differ, as seen on the middle one.
WallFlips wall_flips(const std::vector<PectoralWall>& walls, const PectoralWall& middle, Side side,
                     double z_low, double z_high);

}  // namespace mammotwin
