#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// No scanner's frame reaches farther from its isocentre.
inline constexpr double kFarthestMm = 2000;

/// One `[[lesions]]` of patient.toml: a point, a sphere, markups, or a label map.
struct LesionEntry {
  std::optional<std::string> id;
  std::optional<Eigen::Vector3d> point_lps_mm;
  std::optional<double> radius_mm;
  std::optional<std::filesystem::path> markups;
  std::optional<std::filesystem::path> labels;
  int label = 1;
};

/// Enters the keys of one `[[lesions]]`, below `prefix`.
void declare_lesion(Settings& settings, const std::string& prefix, LesionEntry& entry);

/// Throws BadSetting unless the id can stand in every table, file and page as it is: no control
/// characters, no marks that turn the direction of text, nothing that a spreadsheet takes for a
/// formula.
void require_plain_id(const std::string& where, const std::string& id);

/// Throws BadSetting unless the entry says in exactly one way where the lesion is.
void require_one_place(const std::string& where, const LesionEntry& entry);

}  // namespace mammotwin
