#pragma once

#include <Eigen/Core>
#include <array>

namespace mammotwin {

/// What may differ between a view as it was computed from header and settings and as it was taken.
/// The first seven change the mechanics, the last three only where the breast lies on the detector.
enum StateNumber {
  kThickness,           ///< distance of the plates [mm]
  kRoll,                ///< positioner angle [deg]
  kLift,                ///< plates' middle above the breast's centroid [mm]
  kClearance,           ///< plates' rear edge from the chest wall [mm]
  kTilt,                ///< paddle's front lower [deg]
  kStiffnessRatio,      ///< ln of fibroglandular over fat; one for both views
  kSprings,             ///< ln of the chest wall's springs; one for both views
  kMechanical,          ///< how many of these
  kTurn = kMechanical,  ///< in the detector's plane, from depth towards lateral [deg]
  kShiftDepth,          ///< [mm]
  kShiftLateral,        ///< [mm]
  kStates
};

inline bool shared_by_views(int number) { return number == kStiffnessRatio || number == kSprings; }

/// Differences from what header and settings say, in the units above.
using ViewState = Eigen::Matrix<double, kStates, 1>;

/// Names as they stand in sidecars.
inline constexpr std::array<const char*, kStates> kStateNames = {
    "thickness_mm",       "roll_deg",   "lift_mm",  "clearance_mm",   "tilt_deg",
    "ln_stiffness_ratio", "ln_springs", "turn_deg", "shift_depth_mm", "shift_lateral_mm"};

/// Standard deviations before any mammogram is looked at. Thickness as read off machines (a few mm:
/// compression paddles bend); angle and pose as radiographers differ; moduli by a factor of two as
/// the literature does, springs by a factor of three as they are only known to lie in 0.02 to
/// 0.2 kPa/mm.
inline ViewState prior_sd() {
  ViewState sd;
  sd << 3, 4, 4, 4, 2, 0.7, 1.1, 3, 4, 12;
  return sd;
}

/// The same of a view without a mammogram, of which nobody knows where the detector's edge stands.
/// Of 2,688 pairs of CC views 24.5 % show the pectoral muscle (Strohbach, Wilkinson, Spuur 2020),
/// and in 24.5 % of 200 MLO views it reaches down to the nipple (Spuur, Poulos, Rickard 2008): so
/// the edge stands behind the chest wall in a quarter of both. With a mean of 10 mm in front of it
/// (PlateOptions::wall_clearance) that is a standard deviation of 10 / 0.69 = 14.5 mm: 4 of the
/// plates' clearance, 14 of a shift of the detector, which the mechanics do not feel, as plates
/// cannot stand behind the wall that the mesh ends at.
inline ViewState unseen_sd() {
  ViewState sd = prior_sd();
  sd[kShiftDepth] = 14;
  return sd;
}

}  // namespace mammotwin
