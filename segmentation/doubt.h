#pragma once

#include <Eigen/Core>
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

/// "(12, 30, 60) mm LPS", rounded.
std::string place_text(const Eigen::Vector3d& x_in_lps);

}  // namespace mammotwin
