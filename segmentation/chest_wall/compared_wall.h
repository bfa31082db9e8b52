#pragma once

#include "segmentation/chest_wall/wall_stage.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// The wall as another image of the same study shows it, on the rays of the one that was found.
struct ComparedWall {
  /// [mm] along each of those rays; NaN where no breast lies before the wall: thin skin on bone is
  /// no edge to rely on.
  std::vector<double> radius;
  double z_low = 0, z_high = 0;  ///< slices of the breasts that it shows [mm, LPS]
};

/// Finds the wall in `image` and lays it on the rays of `found`, which was found in `body`. Throws
/// std::runtime_error where the image shows no breast.
ComparedWall compared_wall(const Volume<float>& image, const PectoralWall& found,
                           const BodyStage& body, Side side, double stiffness);

/// Doubts a wall that lies elsewhere, by more than 5 mm, in the other image over more than a tenth
/// of its front: behind the region's breast, beside the breastbone. `called`: the other image.
void judge_compared_wall(const PectoralWall& found, const ComparedWall& compared,
                         const BreastFrame& frame, const BreastRegion& region,
                         const std::string& called, SegmentQuality& quality);

}  // namespace mammotwin
