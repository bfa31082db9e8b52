#include "segmentation/chest_wall/judge_wall.h"

#include <cmath>
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
  const Eigen::Vector3d& x = dispute.middle_in_lps;
  std::ostringstream reason;
  reason << "over " << std::lround(100 * dispute.share)
         << " % of its front the chest wall may as well lie "
         << std::lround(std::abs(dispute.median_mm)) << " mm "
         << (dispute.median_mm > 0 ? "further forward" : "deeper")
         << " than found, in the middle at (" << std::lround(x.x()) << ", " << std::lround(x.y())
         << ", " << std::lround(x.z()) << ") mm LPS: "
         << (dispute.prior_chosen ? "taken was where other women's lies, not the other edge there"
                                  : "taken was the image's edge, which is not where other women's "
                                    "lies");
  quality.doubt(SegmentStatus::look, reason.str());
}

}  // namespace

void judge_wall(const BodyStage& body, const WallStage& wall, Side side, SegmentQuality& quality) {
  quality.chest_wall_doubt = wall.wall.doubt(side, body.frame.z_low, body.frame.z_high);
  if (*quality.chest_wall_doubt > limits::chest_wall_doubt)
    quality.doubt(SegmentStatus::look,
                  "the image does not support " +
                      std::to_string(std::lround(100 * *quality.chest_wall_doubt)) +
                      " % of the chest wall found; expected at most 10 %");
  quality.chest_wall_fat_behind = wall.wall.fat_behind(side, body.frame.z_low, body.frame.z_high);
  if (*quality.chest_wall_fat_behind > limits::chest_wall_fat_behind)
    quality.doubt(SegmentStatus::look,
                  "behind " + std::to_string(std::lround(100 * *quality.chest_wall_fat_behind)) +
                      " % of the chest wall found there is fat rather than muscle; expected at "
                      "most 8 %: it may stand on gland or a lesion in front of the muscle");
  judge_dispute(wall.dispute, quality);
}

void judge_lesions_on_wall(const HalfBreast& half, const Volume<std::uint8_t>& lesions,
                           SegmentQuality& quality) {
  constexpr double most_cm2 = 3;  // a ball of 2 cm pressed flat
  constexpr double cm2 = 100;     // [mm^2]
  const double voxel_mm = std::cbrt(half.body.voxel_volume());
  double area = 0;
  for (std::size_t v = 0; v < lesions.values.size(); ++v)
    if (lesions.values[v] && half.above_wall.values[v] < 1.5 * voxel_mm)
      area += voxel_mm * voxel_mm / cm2;
  if (area > most_cm2)
    quality.doubt(SegmentStatus::look, "a lesion lies on the chest wall over " +
                                           std::to_string(std::lround(area)) +
                                           " cm2; the muscle's front cannot be told from it there");
}

}  // namespace mammotwin
