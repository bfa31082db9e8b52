#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Where the two breasts are, from the outline of the body alone.
struct BreastFrame {
  double midline_x = 0;          ///< cleft (cleft_between) at the height of the apices [mm, LPS]
  double sternal_y = 0;          ///< skin between the breasts [mm, LPS]
  double front_y = 0;            ///< most anterior skin [mm, LPS]
  double z_low = 0, z_high = 0;  ///< slices in which a breast stands out [mm, LPS]
  Eigen::Vector3d left_apex, right_apex;  ///< most anterior skin of each [mm, LPS]

  const Eigen::Vector3d& apex(Side side) const {
    return side == Side::left ? left_apex : right_apex;
  }
};

/// Throws std::runtime_error, saying what is missing, if the outline has no two breasts that stand
/// at least 20 mm out from the skin between them.
BreastFrame find_breast_frame(const Volume<std::uint8_t>& body);

}  // namespace mammotwin
