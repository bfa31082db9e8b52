#pragma once

#include "pipeline/evaluate/niftysim/niftysim_file.h"

namespace mammotwin {

/// Forces of the deformed tetrahedra on their nodes [mN], with NiftySim's own law,
///
///     W = mu/2 (J^(-2/3) I1 − 3) + K/2 (J − 1)²
std::vector<Eigen::Vector3d> nodal_forces(const NiftySimModel& model,
                                          const std::vector<Eigen::Vector3d>& x);

/// What the two plates do to NiftySim's own end state. In equilibrium frictionless plates press
/// along one line; a couple that nothing in the file balances means that the breast is still
/// rolling.
struct PlateCouple {
  double force_N = 0;      ///< mean of both plates
  double offset_mm = 0;    ///< of the lower plate's centre of pressure beside the upper's, along x
  double couple_N_mm = 0;  ///< about z, on the breast
  double roll_acceleration = 0;  ///< that this couple would give it [rad/s^2]
};
PlateCouple plate_couple(const NiftySimModel& model, const std::vector<Eigen::Vector3d>& x);

}  // namespace mammotwin
