#pragma once

#include <Eigen/Core>
#include <string>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// A place in the breast in words, as seen by someone facing the patient, about the nipple.
struct BreastPosition {
  std::string quadrant;  ///< "upper outer", "upper inner", "lower outer", "lower inner", "central"
  std::string clock;     ///< hour "1" to "12"; empty when central
};

/// Nearer to the nipple's antero-posterior axis than this [mm] is "central", as a clock face has no
/// direction there: about half an areola.
inline constexpr double kCentralRadius_mm = 10;

/// From the offset in the coronal plane (LPS x and z) of a lesion from the nipple.
/// 12 is up; facing the patient, 3 is towards the patient's left.
BreastPosition breast_position(Side side, const Eigen::Vector3d& x_in_lps,
                               const Eigen::Vector3d& nipple_in_lps);

/// "anterior", "middle" or "posterior": the third of the breast's depth, from the nipple straight
/// back to the last voxel in front of the muscle, that a point lies in; points in front of the
/// nipple are anterior, behind that voxel posterior. Empty where the labels show no breast behind
/// the nipple.
std::string depth_third(const Segmentation& segmentation, const Eigen::Vector3d& x_in_lps);

}  // namespace mammotwin
