#pragma once

#include <vector>

#include "segmentation/chest_wall/pectoral_wall.h"

namespace mammotwin {

/// A connected piece of the wall.
struct WallPatch {
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();  ///< on the wall [mm]
  double area_cm2 = 0;

  double radius_mm() const;  ///< of a disc of that area
};

/// The largest piece that some rays (indices into `radius`) of the wall make up.
WallPatch largest_patch(const PectoralWall& wall, const std::vector<std::size_t>& rays);

}  // namespace mammotwin
