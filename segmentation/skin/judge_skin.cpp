#include "segmentation/skin/judge_skin.h"

namespace mammotwin {

double judge_skin(const SkinSlab& skin, const SegmentOptions& options, SegmentQuality& quality) {
  if (options.skin_thickness_mm) return quality.skin_thickness_mm = *options.skin_thickness_mm;
  constexpr double largest_misfit = 0.15, thick_mm = 4, usual_skin_mm = 1.5;
  if (!(skin.thickness > 0) || skin.misfit > largest_misfit) {
    quality.doubt(SegmentStatus::look,
                  {"skin",
                   "the skin's thickness could not be measured: 1.5 mm was taken; set "
                   "segment.skin_thickness_mm where known"});
    return quality.skin_thickness_mm = usual_skin_mm;
  }
  if (skin.thickness > thick_mm)
    quality.doubt(SegmentStatus::look,
                  {"skin",
                   "the skin measures more than 4 mm; expected 1 to 3 mm (is it swollen, or does "
                   "gland lie right under it?)"});
  if (!skin.over_fat)
    quality.doubt(SegmentStatus::look,
                  {"skin",
                   "gland lies under nearly all of the skin and may pass for it: the skin's "
                   "thickness is not known; set segment.skin_thickness_mm where it is"});
  quality.skin_thickness_low_mm = skin.over_fat ? skin.low : thinnest_measured_skin_mm;
  quality.skin_thickness_high_mm = skin.over_fat ? skin.high : thickest_measured_skin_mm;
  return quality.skin_thickness_mm = skin.thickness;
}

}  // namespace mammotwin
