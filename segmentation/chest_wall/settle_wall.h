#pragma once

#include "segmentation/chest_wall/wall_patch.h"

namespace mammotwin {

/// Where two walls of one side differ by more than 5 mm.
struct WallDispute {
  double share = 0;  ///< of the wall in front of that side
  double median_mm =
      0;  ///< the other wall's radius less the chosen one's; positive: further forward
  bool prior_chosen = false;
  WallPatch patch;  ///< the largest piece of the chosen wall where they differ
};

struct SettledWall {
  PectoralWall wall;
  WallDispute left, right;
};

/// Of each side the wall found without the prior (wall_prior.h), unless the one with it differs
/// somewhere by more than 5 mm and keeps the image's support there (of the rays that differ, doubt
/// and fat behind together grow by 0.15 at most): liver and heart have edges as good as muscle's,
/// so the usual place decides between two edges; but a chest unlike others keeps its own. Both
/// walls have the same grid.
SettledWall settled_wall(const PectoralWall& by_image, const PectoralWall& with_prior, double z_low,
                         double z_high);

}  // namespace mammotwin
