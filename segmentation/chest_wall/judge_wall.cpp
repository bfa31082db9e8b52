#include "segmentation/chest_wall/judge_wall.h"

#include <cmath>

#include "segmentation/segment_limits.h"

namespace mammotwin {

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
