#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/frame/products.h"
#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

/// What somebody read in a mammogram by eye, in pixels.
struct ReadMammogram {
  std::filesystem::path file;
  std::string view;  ///< cc or mlo
  double pixel_mm = 0;
  bool wall_at_left = true;
  std::optional<Eigen::Vector2d> nipple;
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pectoral;  ///< upper, lower point
  std::vector<Eigen::Vector2d> skin;  ///< at a quarter, half and three quarters of its rows

  bool oblique() const { return view == "mlo"; }
  std::vector<Eigen::Vector2d> marks() const;
};

/// Reads landmarks.csv of a folder of mammograms. Throws std::runtime_error naming the file, and a
/// column that is missing.
std::vector<ReadMammogram> read_landmarks(const std::filesystem::path& folder);

/// file, view, outline_worst_mm, nipple_mm, nipple_sd_mm, pectoral_worst_mm, pectoral_sd_mm, unsure
/// and remarks: how far the findings lie from what was read; null where either is missing.
nlohmann::json mammogram_row(const ReadMammogram& read, const MammogramFindings& found);

/// How many rows are right, unsure and wrong: skin within 3 mm, nipple and pectoral edge within 5;
/// and what errors are over their standard deviations.
nlohmann::json mammogram_counts(const nlohmann::json& rows);

/// Writes {"counts", "cases"} as the main product, commits, and prints the counts.
void commit_counted(const nlohmann::json& counts, const nlohmann::json& cases, Products& products);

}  // namespace mammotwin
