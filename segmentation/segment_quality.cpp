#include "segmentation/segment_quality.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "segmentation/mirrored.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json point(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

json optional_number(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

json lesions_json(const std::vector<Lesion>& lesions) {
  json list = json::array();
  for (const Lesion& lesion : lesions)
    list.push_back({{"id", lesion.id},
                    {"centroid_lps_mm", point(lesion.centroid_in_lps)},
                    {"volume_ml", lesion.volume_ml}});
  return list;
}

json doubts_json(const std::vector<Doubt>& doubts) {
  json list = json::array();
  for (const Doubt& doubt : doubts)
    list.push_back({{"what", doubt.what},
                    {"reason", doubt.reason},
                    {"place_lps_mm", doubt.place_in_lps ? point(*doubt.place_in_lps) : json()},
                    {"radius_mm", doubt.radius_mm}});
  return list;
}

json candidates_json(const std::vector<LesionCandidate>& candidates) {
  json list = json::array();
  for (const LesionCandidate& c : candidates)
    list.push_back({{"centroid_lps_mm", point(c.centroid_in_lps)},
                    {"volume_ml", c.volume_ml},
                    {"enhancement", c.enhancement}});
  return list;
}

}  // namespace

std::string place_text(const Eigen::Vector3d& x) {
  std::ostringstream text;
  text << "(" << std::lround(x.x()) << ", " << std::lround(x.y()) << ", " << std::lround(x.z())
       << ") mm LPS";
  return text.str();
}

void SegmentQuality::doubt(SegmentStatus at_least, const Doubt& told) {
  Doubt doubt = told;
  if (in_mirror && doubt.place_in_lps) doubt.place_in_lps = mirrored(*doubt.place_in_lps);
  status = std::max(status, at_least);
  // What a person can do about it (docs/correct_segmentation.md) is said once.
  const bool first = std::none_of(doubts.begin(), doubts.end(),
                                  [&](const Doubt& other) { return other.what == doubt.what; });
  reasons.push_back(doubt.reason +
                    (doubt.place_in_lps ? "; look at " + place_text(*doubt.place_in_lps) : "") +
                    (first && doubt.what == "chest wall"
                         ? "; where it is wrong, draw it in a few slices (chest_wall.markups)"
                         : ""));
  doubts.push_back(doubt);
}

std::string to_string(SegmentStatus status) {
  switch (status) {
    case SegmentStatus::ok:
      return "ok";
    case SegmentStatus::look:
      return "look";
    default:
      return "refused";
  }
}

std::string to_string(Side side) { return side == Side::left ? "left" : "right"; }

json to_json(const SegmentQuality& q) {
  return {
      {"side", to_string(q.side)},
      {"patient_position", q.patient_position.empty() ? json(nullptr) : json(q.patient_position)},
      {"contrast", q.contrast},
      {"breast_volume_ml", q.breast_volume_ml},
      {"fat_ml", q.fat_ml},
      {"fibroglandular_ml", q.fibroglandular_ml},
      {"skin_ml", q.skin_ml},
      {"lesions", lesions_json(q.lesions)},
      {"skin_thickness_mm", q.skin_thickness_mm},
      {"skin_thickness_range_mm",
       {optional_number(q.skin_thickness_low_mm), optional_number(q.skin_thickness_high_mm)}},
      {"nipple_lps_mm", point(q.nipple_in_lps)},
      {"nipple_sd_mm", optional_number(q.nipple_sd_mm)},
      {"chest_wall_doubt", optional_number(q.chest_wall_doubt)},
      {"chest_wall_fat_behind", optional_number(q.chest_wall_fat_behind)},
      {"chest_wall_disputed", optional_number(q.chest_wall_disputed)},
      {"chest_wall_unsteady", optional_number(q.chest_wall_unsteady)},
      {"chest_wall_unlike_compared", optional_number(q.chest_wall_unlike_compared)},
      {"failed_suppression_ml", optional_number(q.failed_suppression_ml)},
      {"vessels_ml", optional_number(q.vessels_ml)},
      {"pre_shift_mm", optional_number(q.pre_shift_mm)},
      {"signal_to_noise", optional_number(q.signal_to_noise)},
      {"clipped_share", optional_number(q.clipped_share)},
      {"pendant_outside", optional_number(q.pendant_outside)},
      {"volume_ratio", optional_number(q.volume_ratio)},
      {"doubts", doubts_json(q.doubts)},
      {"lesion_candidates", candidates_json(q.candidates)},
      {"lesion_agreement", q.lesion_agreement},
      {"series", to_json(q.series)},
      {"notes", q.notes}};
}

}  // namespace mammotwin
