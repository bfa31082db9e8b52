#pragma once

#include <Eigen/Core>
#include <array>

namespace mammotwin {

/// What may differ between a view as it was computed from header and settings and as it was taken.
/// The first nine change the mechanics, the last three only where the breast lies on the detector.
enum StateNumber {
  kThickness,           ///< distance of the plates [mm]
  kRoll,                ///< positioner angle [deg]
  kLift,                ///< plates' middle above the breast's centroid [mm]
  kClearance,           ///< plates' rear edge from the chest wall [mm]
  kTilt,                ///< paddle's front lower [deg]
  kStiffnessRatio,      ///< ln of fibroglandular over fat; one for both views
  kSprings,             ///< ln of the chest wall's springs; one for both views
  kFriction,            ///< coefficient with the plates [-]; one for both views
  kCoilRoundness,       ///< of the breast free of load, where a coil pressed it [-]; for both views
  kMechanical,          ///< how many of these
  kTurn = kMechanical,  ///< in the detector's plane, from depth towards lateral [deg]
  kShiftDepth,          ///< [mm]
  kShiftLateral,        ///< [mm]
  kStates
};

inline bool shared_by_views(int number) {
  return number >= kStiffnessRatio && number <= kCoilRoundness;
}

/// Differences from what header and settings say, in the units above.
using ViewState = Eigen::Matrix<double, kStates, 1>;

/// Names as they stand in sidecars.
inline constexpr std::array<const char*, kStates> kStateNames = {
    "thickness_mm",   "roll_deg",           "lift_mm",        "clearance_mm",
    "tilt_deg",       "ln_stiffness_ratio", "ln_springs",     "friction",
    "coil_roundness", "turn_deg",           "shift_depth_mm", "shift_lateral_mm"};

inline constexpr double kCoilRoundnessSd = 0.12;

/// Configuration of an unloaded mesh whose breast a coil pressed: free of load, one standard
/// deviation rounder than the mesh.
inline constexpr const char* kRounderByCoil = "rounder_by_coil";

/// Standard deviations before any mammogram is looked at. Thickness as read off machines (a few mm:
/// compression paddles bend); angle and pose as radiographers differ, who roll a breast on the
/// support by more degrees than they turn the gantry off what the header says; the place on the
/// detector by centimetres (its edge: edge_prior.h); moduli by a factor of two as the literature
/// does, springs by a factor of three as they are only known to lie in 0.02 to 0.2 kPa/mm, friction
/// as it differs between people and materials (Zhang and Mak 1999). Roundness as it differs between
/// the 12 sides of label maps that no coil presses (0.08 as imaged), and as what pressed is
/// guessed.
inline ViewState prior_sd() {
  ViewState sd;
  sd << 4, 6, 4, 4, 2, 0.7, 1.1, 0.15, kCoilRoundnessSd, 3, 12, 12;
  return sd;
}

}  // namespace mammotwin
