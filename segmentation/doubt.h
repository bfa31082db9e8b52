#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace mammotwin {

/// Something in a segmentation that a person should look at.
struct Doubt {
  std::string what;    ///< "chest wall", "nipple", "lesion L1", ...
  std::string reason;  ///< a sentence that says how much
  std::optional<Eigen::Vector3d> place_in_lps = std::nullopt;  ///< its middle [mm], unless of all
  double radius_mm = 0;  ///< how far it reaches round that place
};

/// Radius [mm] of a ball of so many millilitres, for what has a volume and no shape.
inline double ball_radius_mm(double ml) {
  return std::cbrt(750 * ml / std::numbers::pi);  // 3 / (4 pi), in mm^3
}

/// "(12, 30, 60) mm LPS", rounded.
std::string place_text(const Eigen::Vector3d& x_in_lps);

}  // namespace mammotwin
