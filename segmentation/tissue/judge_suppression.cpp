#include "segmentation/tissue/judge_suppression.h"

#include <sstream>

#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

/// Volume [ml] that is brighter than twice fat after smoothing by 6 mm: suppression has failed.
double failed_suppression_ml(const Volume<float>& image, const Volume<std::uint8_t>& interior) {
  constexpr double block_mm = 3, smoothing_mm = 6, alarm = 2;
  Volume<float> share;
  const Volume<float> coarse = block_means(image, interior, block_mm, share);
  const Volume<float> smooth = weighted_smoothed(coarse, share, smoothing_mm);
  double count = 0;
  for (std::size_t v = 0; v < smooth.values.size(); ++v)
    if (smooth.values[v] > alarm) count += share.values[v];
  return count * smooth.voxel_volume() / 1000;
}

}  // namespace

void judge_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                       SegmentQuality& quality) {
  constexpr double alarm_ml = 5;  // study: 0 to 2.4 where it worked, 66 to 126 where it failed
  const double ml = failed_suppression_ml(image, interior);
  quality.failed_suppression_ml = ml;
  if (ml <= alarm_ml) return;
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(0);
  reason << "fat suppression seems to have failed in " << ml
         << " ml of the breast: bright fat there passes for fibroglandular tissue";
  quality.doubt(SegmentStatus::look, {"fat suppression", reason.str()});
}

}  // namespace mammotwin
