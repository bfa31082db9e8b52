#include "segmentation/chest_wall/judge_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "segmentation/segment_limits.h"

namespace mammotwin {

namespace {

/// An edge in front of the usual place stays where it is when looked for otherwise: what lies
/// deeper is an edge of liver, heart or lung. Gland in front of muscle is what `fat_behind` sees.
bool is_beyond_dispute(const WallDispute& dispute, const WallFlips& flips) {
  constexpr double steady =
      0.02;  // of the wall; 0.003 on a real one, 0.41 where the other was right
  return dispute.median_mm < 0 && flips.share <= steady;
}

/// A second wall that image and prior allow is said, whichever was taken.
void judge_dispute(const WallDispute& dispute, const WallFlips& flips, bool by_prior,
                   SegmentQuality& quality) {
  quality.chest_wall_disputed = dispute.share;
  if (dispute.share <= (by_prior ? limits::chest_wall_disputed : limits::chest_wall_unlike_others))
    return;
  if (!by_prior && is_beyond_dispute(dispute, flips)) return;
  std::ostringstream reason;
  reason << "over " << std::lround(100 * dispute.share)
         << " % of its front the chest wall may as well lie "
         << std::lround(std::abs(dispute.median_mm)) << " mm "
         << (dispute.median_mm > 0 ? "further forward" : "deeper") << " than found: "
         << (by_prior ? "taken was where other women's lies, not the other edge there"
                      : "taken was the image's edge, which is not where other women's "
                        "lies");
  quality.doubt(SegmentStatus::look, {"chest wall", reason.str(), dispute.patch.middle_in_lps,
                                      dispute.patch.radius_mm()});
}

/// A wall that depends on what is known only roughly beforehand.
void judge_flips(const WallFlips& flips, SegmentQuality& quality) {
  quality.chest_wall_unsteady = flips.share;
  if (flips.share <= limits::chest_wall_unsteady) return;
  quality.doubt(
      SegmentStatus::look,
      {"chest wall",
       "over " + std::to_string(std::lround(100 * flips.share)) +
           " % of its front the chest wall moves by " +
           std::to_string(std::lround(flips.median_mm)) +
           " mm when it is looked for a little otherwise: the image shows two edges there",
       flips.patch.middle_in_lps, flips.patch.radius_mm()});
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

void judge_wall(const FoundWall& found, const BreastFrame& frame, const BreastRegion& region,
                SegmentQuality& quality) {
  const PectoralWall& wall = found.wall;
  const Side side = region.side;
  const double low = std::max(frame.z_low, region.z_min),
               high = std::min(frame.z_high, region.z_max);
  quality.chest_wall_doubt = wall.doubt(side, low, high);
  if (*quality.chest_wall_doubt > limits::chest_wall_doubt)
    doubt_rays(wall, wall.unsupported(side, low, high),
               "the image does not support " +
                   std::to_string(std::lround(100 * *quality.chest_wall_doubt)) +
                   " % of the chest wall found; expected at most 10 %",
               quality);
  quality.chest_wall_fat_behind = wall.fat_behind(side, low, high);
  if (*quality.chest_wall_fat_behind > limits::chest_wall_fat_behind)
    doubt_rays(wall, wall.before_fat(side, low, high),
               "behind " + std::to_string(std::lround(100 * *quality.chest_wall_fat_behind)) +
                   " % of the chest wall found there is fat rather than muscle; expected at most "
                   "8 %: it may stand on gland or a lesion in front of the muscle",
               quality);
  const WallFlips flips = wall_flips(found.searches, wall, side, low, high);
  judge_dispute(wall_dispute(found.first.wall, found.first.other, side, low, high), flips,
                found.first.by_prior(side), quality);
  judge_flips(flips, quality);
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
