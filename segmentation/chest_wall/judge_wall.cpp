#include "segmentation/chest_wall/judge_wall.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "segmentation/segment_limits.h"

namespace mammotwin {

namespace {

/// A second wall that image and prior allow is said, whichever was taken.
void judge_dispute(const WallDispute& dispute, SegmentQuality& quality) {
  quality.chest_wall_disputed = dispute.share;
  if (dispute.share <=
      (dispute.prior_chosen ? limits::chest_wall_disputed : limits::chest_wall_unlike_others))
    return;
  std::ostringstream reason;
  reason << "over " << std::lround(100 * dispute.share)
         << " % of its front the chest wall may as well lie "
         << std::lround(std::abs(dispute.median_mm)) << " mm "
         << (dispute.median_mm > 0 ? "further forward" : "deeper") << " than found: "
         << (dispute.prior_chosen ? "taken was where other women's lies, not the other edge there"
                                  : "taken was the image's edge, which is not where other women's "
                                    "lies");
  quality.doubt(SegmentStatus::look, {"chest wall", reason.str(), dispute.patch.middle_in_lps,
                                      dispute.patch.radius_mm()});
}

/// Doubts the wall where some of its rays lie.
void doubt_rays(const PectoralWall& wall, const std::vector<std::size_t>& rays,
                const std::string& reason, SegmentQuality& quality) {
  const WallPatch patch = largest_patch(wall, rays);
  quality.doubt(SegmentStatus::look, {"chest wall",
                                      reason + "; its largest piece has " +
                                          std::to_string(std::lround(patch.area_cm2)) + " cm2",
                                      patch.middle_in_lps, patch.radius_mm()});
}

}  // namespace

void judge_wall(const BodyStage& body, const WallStage& wall, Side side, SegmentQuality& quality) {
  const double low = body.frame.z_low, high = body.frame.z_high;
  quality.chest_wall_doubt = wall.wall.doubt(side, low, high);
  if (*quality.chest_wall_doubt > limits::chest_wall_doubt)
    doubt_rays(wall.wall, wall.wall.unsupported(side, low, high),
               "the image does not support " +
                   std::to_string(std::lround(100 * *quality.chest_wall_doubt)) +
                   " % of the chest wall found; expected at most 10 %",
               quality);
  quality.chest_wall_fat_behind = wall.wall.fat_behind(side, low, high);
  if (*quality.chest_wall_fat_behind > limits::chest_wall_fat_behind)
    doubt_rays(wall.wall, wall.wall.before_fat(side, low, high),
               "behind " + std::to_string(std::lround(100 * *quality.chest_wall_fat_behind)) +
                   " % of the chest wall found there is fat rather than muscle; expected at most "
                   "8 %: it may stand on gland or a lesion in front of the muscle",
               quality);
  judge_dispute(wall.dispute, quality);
}

void judge_lesions_on_wall(const HalfBreast& half, const Volume<std::uint8_t>& lesions,
                           SegmentQuality& quality) {
  constexpr double most_cm2 = 3;  // a ball of 2 cm pressed flat
  constexpr double mm2_per_cm2 = 100;
  const double voxel_mm = std::cbrt(half.body.voxel_volume());
  int touching = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < lesions.size.z(); ++k)
    for (int j = 0; j < lesions.size.y(); ++j)
      for (int i = 0; i < lesions.size.x(); ++i)
        if (lesions(i, j, k) && half.above_wall(i, j, k) < 1.5 * voxel_mm)
          ++touching, sum += lesions.position(i, j, k);
  const double mm2 = touching * voxel_mm * voxel_mm;
  if (mm2 <= most_cm2 * mm2_per_cm2) return;
  quality.doubt(SegmentStatus::look, {"chest wall",
                                      "a lesion lies on the chest wall over " +
                                          std::to_string(std::lround(mm2 / mm2_per_cm2)) +
                                          " cm2; the muscle's front cannot be told from it there",
                                      sum / touching, std::sqrt(mm2 / std::numbers::pi)});
}

}  // namespace mammotwin
