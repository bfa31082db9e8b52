#include "segmentation/tissue_scan.h"

#include <cmath>
#include <sstream>

#include "segmentation/pre_match.h"
#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

void doubt_movement(double shift_mm, SegmentQuality& quality) {
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(1);
  reason << "the image before contrast agent lies " << shift_mm
         << " mm off the one after it; expected " << limits::pre_shift_mm
         << " mm at most (did the patient move?): lesions outlined in their difference may be "
            "wrong";
  quality.doubt(SegmentStatus::look, reason.str());
}

void average_with_pre(const Volume<float>& pre, double pre_scale, TissueScan& scan) {
  const auto scale = static_cast<float>(pre_scale);
  for (std::size_t v = 0; v < scan.image.values.size(); ++v) {
    scan.image.values[v] = (scan.image.values[v] + scale * pre.values[v]) / 2;
    scan.noise.values[v] *= std::sqrt(1 + scale * scale) / 2;
  }
}

}  // namespace

TissueScan tissue_scan(const HalfBreast& half, SegmentQuality& quality) {
  TissueScan scan{half.scan, half.noise};
  if (!half.pre.values.empty()) {
    const PreMatch match = match_pre(half.scan, half.pre, half.noise, half.inside);
    quality.pre_shift_mm = match.shift_mm;
    if (match.shift_mm.value_or(0) > limits::pre_shift_mm)
      doubt_movement(*match.shift_mm, quality);
    else
      average_with_pre(half.pre, match.scale, scan);
  }
  for (float& noise : scan.noise.values) noise *= static_cast<float>(half.noise_spread);
  return scan;
}

}  // namespace mammotwin
