#include "segmentation/body/judge_region.h"

#include <cmath>
#include <sstream>

#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double outside_radius_mm = 20;  // shown of what lies outside

void judge_outside(const OutsideRegion& outside, SegmentQuality& quality) {
  quality.pendant_outside = outside.share;
  if (outside.share <= limits::pendant_outside) return;
  std::ostringstream reason;
  reason << std::lround(100 * outside.share) << " % (" << std::lround(outside.volume_ml)
         << " ml) of the tissue that hangs in front of the breastbone's skin lies outside the "
            "breast's region; expected at most "
         << std::lround(100 * limits::pendant_outside)
         << " % (does the chest wall reach the skin there, or is the outline wrong? it can be "
            "given as a box: region.markups)";
  quality.doubt(
      outside.share > limits::pendant_outside_refused ? SegmentStatus::refused
                                                      : SegmentStatus::look,
      {"region", reason.str(), outside.middle_in_lps, std::cbrt(outside.volume_ml * 1000)});
}

void judge_lesions(const Segmentation& s, SegmentQuality& quality) {
  for (const Lesion& lesion : s.lesions)
    if (!s.region.contains(lesion.centroid_in_lps))
      quality.doubt(SegmentStatus::refused,
                    {"lesion " + lesion.id,
                     "lesion " + lesion.id +
                         " lies outside the breast's region; no later stage would see it (is the "
                         "side right?)",
                     lesion.centroid_in_lps, outside_radius_mm});
}

}  // namespace

void judge_region(const FoundRegion& found, const Segmentation& s, SegmentQuality& quality) {
  judge_outside(found.outside, quality);
  judge_lesions(s, quality);
  if (!s.region.contains(s.nipple_in_lps))
    quality.doubt(SegmentStatus::refused,
                  {"nipple", "the nipple lies outside the breast's region; expected it inside",
                   s.nipple_in_lps, outside_radius_mm});
}

void judge_nipple(const Nipple& nipple, SegmentQuality& quality) {
  constexpr double shown_mm = 15;
  quality.nipple_sd_mm = nipple.sd_mm;
  if (!nipple.is_found)
    return quality.doubt(SegmentStatus::look,
                         {"nipple",
                          "no nipple shows on the skin: it was taken as the most anterior point; "
                          "give nipple.point_lps_mm where it is seen",
                          nipple.tip_in_lps, shown_mm});
  std::ostringstream text;
  text << "standard deviation " << std::lround(nipple.sd_mm) << " mm";
  if (nipple.sd_mm <= limits::nipple_sd_mm)
    return quality.notes.push_back("the nipple was found by what it shows, " + text.str());
  text << "; it may as well lie at " << place_text(nipple.rival_in_lps)
       << "; give nipple.point_lps_mm where it is seen";
  quality.doubt(SegmentStatus::look,
                {"nipple", "the nipple shows weakly, " + text.str(), nipple.tip_in_lps, shown_mm});
}

}  // namespace mammotwin
