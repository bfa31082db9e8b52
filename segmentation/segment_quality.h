#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/contrast_agent/enhancement.h"
#include "segmentation/doubt.h"
#include "segmentation/mri/series_choice.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

enum class SegmentStatus { ok, look, refused };

/// How far a segmentation may be believed. What was not measured is empty.
struct SegmentQuality {
  SegmentStatus status = SegmentStatus::ok;
  std::vector<std::string> reasons;  ///< why the status is not ok, in sentences
  std::vector<Doubt> doubts;         ///< the same, one a reason: what and where
  std::vector<std::string> notes;    ///< what was chosen or assumed, in sentences
  std::vector<SeriesRow> series;     ///< of which one was chosen; empty without a choice

  Side side = Side::left;
  bool in_mirror = false;        ///< doubts' places are told of the mirror image (mirrored.h)
  std::string patient_position;  ///< DICOM's code ("HFP": head first, prone); empty: not known
  std::string contrast;          ///< "fat-suppressed", "not fat-suppressed" or "labels"
  double breast_volume_ml = 0, fat_ml = 0, fibroglandular_ml = 0, skin_ml = 0;  ///< in the region
  std::vector<Lesion> lesions;
  double skin_thickness_mm = 0;
  std::optional<double> skin_thickness_low_mm, skin_thickness_high_mm;  ///< range it may have
  Eigen::Vector3d nipple_in_lps = Eigen::Vector3d::Zero();              ///< [mm]

  std::optional<double> nipple_sd_mm;           ///< Nipple's, where it was looked for
  std::optional<double> chest_wall_doubt;       ///< share of the wall without support, 0 to 1
  std::optional<double> chest_wall_fat_behind;  ///< share of the wall with fat behind it
  std::optional<double> chest_wall_disputed;    ///< share where it may as well lie elsewhere
  std::optional<double> chest_wall_unsteady;    ///< share that moves when looked for otherwise
  /// Share that lies elsewhere in another image of the study.
  std::optional<double> chest_wall_unlike_compared;
  std::optional<double> failed_suppression_ml;  ///< breast brighter than twice fat
  std::optional<double> vessels_ml;             ///< in the region; empty where none can be told
  std::optional<double> pre_shift_mm;           ///< PreMatch, of an image before contrast agent
  std::optional<double> signal_to_noise;        ///< fat over the noise between neighbours
  std::optional<double> clipped_share;          ///< of the skin's outline at the image's border
  std::optional<double> pendant_outside;        ///< share of the pendant tissue outside the region
  std::optional<double> volume_ratio;           ///< of the two breasts, smaller over larger
  /// What takes up contrast agent, where an image before it is given; offered, not segmented.
  std::vector<LesionCandidate> candidates;
  std::vector<double> lesion_agreement;  ///< Dice of two methods, one a lesion

  /// Adds a doubt, its place turned back where that is told in a mirror, and its reason, which
  /// names the place and, the first time, what a person can do about it; makes the status at least
  /// this bad.
  void doubt(SegmentStatus at_least, const Doubt& doubt);
};

std::string to_string(SegmentStatus status);
std::string to_string(Side side);

/// The `quality` object of the sidecar (design, section 1), without status and reasons.
nlohmann::json to_json(const SegmentQuality& quality);

}  // namespace mammotwin
