#include "segmentation/body/judge_region.h"

#include <cmath>
#include <sstream>

#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

std::string place(const Eigen::Vector3d& x) {
  std::ostringstream text;
  text << "(" << std::lround(x.x()) << ", " << std::lround(x.y()) << ", " << std::lround(x.z())
       << ") mm LPS";
  return text.str();
}

void judge_outside(const OutsideRegion& outside, SegmentQuality& quality) {
  quality.pendant_outside = outside.share;
  if (outside.share <= limits::pendant_outside) return;
  std::ostringstream reason;
  reason << std::lround(100 * outside.share) << " % (" << std::lround(outside.volume_ml)
         << " ml) of the tissue that hangs in front of the breastbone's skin lies outside the "
            "breast's region, in the middle at "
         << place(outside.middle_in_lps) << "; expected at most "
         << std::lround(100 * limits::pendant_outside)
         << " % (does the chest wall reach the skin there, or is the outline wrong?)";
  quality.doubt(outside.share > limits::pendant_outside_refused ? SegmentStatus::refused
                                                                : SegmentStatus::look,
                reason.str());
}

void judge_lesions(const Segmentation& s, SegmentQuality& quality) {
  for (const Lesion& lesion : s.lesions)
    if (!s.region.contains(lesion.centroid_in_lps))
      quality.doubt(SegmentStatus::refused,
                    "lesion " + lesion.id + " at " + place(lesion.centroid_in_lps) +
                        " lies outside the breast's region; no later stage would see it (is the "
                        "side right?)");
}

}  // namespace

void judge_region(const FoundRegion& found, const Segmentation& s, SegmentQuality& quality) {
  judge_outside(found.outside, quality);
  judge_lesions(s, quality);
  if (!s.region.contains(s.nipple_in_lps))
    quality.doubt(SegmentStatus::refused,
                  "the nipple at " + place(s.nipple_in_lps) +
                      " lies outside the breast's region; expected it inside");
}

void judge_nipple(const Nipple& nipple, SegmentQuality& quality) {
  constexpr double nearly = 0.6, elsewhere_mm = 15;
  if (!(nipple.stands_out_mm > 0))
    return quality.doubt(SegmentStatus::look,
                         "no nipple stands out of the skin: it was taken as the most anterior "
                         "point, " +
                             place(nipple.tip_in_lps) +
                             "; give nipple.point_lps_mm where it is seen");
  std::ostringstream note;
  note.precision(2);
  note << "the nipple was found as what stands out of the skin by " << nipple.stands_out_mm
       << " mm";
  quality.notes.push_back(note.str());
  const double apart = (nipple.rival_in_lps - nipple.tip_in_lps).norm();
  if (nipple.rival_share > nearly && apart > elsewhere_mm)
    quality.doubt(SegmentStatus::look,
                  "the nipple was taken at " + place(nipple.tip_in_lps) + ", but the skin at " +
                      place(nipple.rival_in_lps) +
                      " stands out nearly as well; give nipple.point_lps_mm if it is there");
}

}  // namespace mammotwin
