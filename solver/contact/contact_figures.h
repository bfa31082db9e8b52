#pragma once

#include <utility>
#include <vector>

#include "solver/contact/plate_friction.h"
#include "solver/newton/model.h"

namespace mammotwin {

using FaceList = std::vector<std::pair<int, int>>;  ///< (element, face) with a surface potential

/// What one plate does to a state: sums over the quadrature points in contact. friction: null if
/// there is none.
struct ContactFigures {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< of the plate on the tissue [mN]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of that force about the origin [mN mm]
  double area = 0;         ///< deformed area within 0.1 mm of the plate [mm²]
  double penetration = 0;  ///< largest [mm]
};
ContactFigures contact_figures(const Model& model, const State& state, const PlateContact& contact,
                               int plate, const FaceList& faces,
                               const PlateFriction* friction = nullptr);

/// What the plates press each surface point with, as PlateContact::multipliers has it [kPa].
std::vector<double> contact_pressures(const Model& model, const State& state,
                                      const PlateContact& contact, const FaceList& faces);

}  // namespace mammotwin
