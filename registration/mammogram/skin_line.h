#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// The skin of a breast from its upper to its lower end, (depth, row) [mm] in the upright image.
struct SkinLine {
  std::vector<Eigen::Vector2d> points;  ///< about a pixel apart
  std::vector<std::string> remarks;     ///< what was cut off, and why
  double roughness_mm = 0;              ///< spread of the points about their mean over 15 mm
};

/// Follows the border of an upright mask (chest wall left) where it is not the image's own. It ends
/// where skin returns to the chest wall: what rises again behind a valley of 3 mm, below (abdomen,
/// folds) or above the breast (axilla, arm), is cut off; so is, at the lower end of either view,
/// what follows a corner of 6 mm and, there and at the upper end of `oblique == false`, what lies
/// behind a hollow of 4 mm. Throws std::runtime_error where no skin is seen.
SkinLine skin_line(const MammogramImage& mask, double pixel_mm, bool oblique);

}  // namespace mammotwin
