#pragma once

#include <Eigen/Core>
#include <array>

namespace mammotwin {

/// What may differ between a view as it was computed from header and settings and as it was taken.
/// The first eight change the mechanics, the last three only where the breast lies on the detector.
enum StateNumber {
  kThickness,           ///< distance of the plates [mm]
  kRoll,                ///< positioner angle [deg]
  kLift,                ///< plates' middle above the breast's centroid [mm]
  kClearance,           ///< plates' rear edge from the chest wall [mm]
  kTilt,                ///< paddle's front lower [deg]
  kStiffnessRatio,      ///< ln of fibroglandular over fat; one for both views
  kSprings,             ///< ln of the chest wall's springs; one for both views
  kFriction,            ///< coefficient with the plates [-]; one for both views
  kMechanical,          ///< how many of these
  kTurn = kMechanical,  ///< in the detector's plane, from depth towards lateral [deg]
  kShiftDepth,          ///< [mm]
  kShiftLateral,        ///< [mm]
  kStates
};

inline bool shared_by_views(int number) { return number >= kStiffnessRatio && number <= kFriction; }

/// Differences from what header and settings say, in the units above.
using ViewState = Eigen::Matrix<double, kStates, 1>;

/// Names as they stand in sidecars.
inline constexpr std::array<const char*, kStates> kStateNames = {
    "thickness_mm", "roll_deg",           "lift_mm",         "clearance_mm",
    "tilt_deg",     "ln_stiffness_ratio", "ln_springs",      "friction",
    "turn_deg",     "shift_depth_mm",     "shift_lateral_mm"};

/// Standard deviations before any mammogram is looked at. Thickness as read off machines (a few mm:
/// compression paddles bend); angle and pose as radiographers differ, who roll a breast on the
/// support by more degrees than they turn the gantry off what the header says; the place on the
/// detector by centimetres (its edge: edge_prior.h); moduli by a factor of two as the literature
/// does, springs by a factor of three as they are only known to lie in 0.02 to 0.2 kPa/mm, friction
/// as it differs between people and materials (Zhang and Mak 1999).
inline ViewState prior_sd() {
  ViewState sd;
  sd << 4, 6, 4, 4, 2, 0.7, 1.1, 0.15, 3, 12, 12;
  return sd;
}

}  // namespace mammotwin
