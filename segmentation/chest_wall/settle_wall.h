#pragma once

#include "segmentation/chest_wall/wall_patch.h"

namespace mammotwin {

/// Where two walls of one side differ by more than 5 mm.
struct WallDispute {
  double share = 0;  ///< of the wall in front of that side
  double median_mm =
      0;            ///< the other wall's radius less the chosen one's; positive: further forward
  WallPatch patch;  ///< the largest piece of the chosen wall where they differ
};

WallDispute wall_dispute(const PectoralWall& chosen, const PectoralWall& other, Side side,
                         double z_low, double z_high);

struct SettledWall {
  PectoralWall wall, other;  ///< of each side the chosen one, and the one that was not
  bool left_by_prior = false, right_by_prior = false;  ///< the one with the prior was chosen

  bool by_prior(Side side) const { return side == Side::left ? left_by_prior : right_by_prior; }
};

/// Of each side the wall found without the prior (wall_prior.h), unless the one with it differs
/// somewhere by more than 5 mm and keeps the image's support there (of the rays that differ, doubt
/// and fat behind together grow by 0.15 at most): liver and heart have edges as good as muscle's,
/// so the usual place decides between two edges; but a chest unlike others keeps its own. Where the
/// image's wall lies more than 15 mm deeper, which is no chest's, they may grow by 0.5. Both walls
/// have the same grid.
SettledWall settled_wall(const PectoralWall& by_image, const PectoralWall& with_prior, double z_low,
                         double z_high);

}  // namespace mammotwin
