#pragma once

#include <optional>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// What immobilising plates of a breast coil leave on a breast that does not hang free: skin that
/// is plane on both sides.
struct CoilPlates {
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  ///< from one plane to the other, unit
  double left_cm2 = 0, right_cm2 = 0;  ///< of plane skin on the patient's left and right (LPS)
  double apart_mm = 0;
};

/// Looks for plane patches of skin on both sides of the imaged breast that face each other: skin
/// within 1 mm of a plane and 6 degrees of its normal, which runs within 45 degrees of left or
/// right; the two within 12 degrees of parallel. Of all pairs the one whose smaller patch is
/// largest; `across` is the mean of all, weighted by the 8th power of the smaller's area. Empty
/// where the pair's smaller patch is under 0.12 of the breast's volume to the power 2/3.
std::optional<CoilPlates> find_coil_plates(const MeshFile& imaged);

}  // namespace mammotwin
