#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace mammotwin
