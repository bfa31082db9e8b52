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
  double load = 0;         ///< normal forces without their directions [mN]
  double mean_gap = 0;     ///< mean |gap| weighed by pressure: 0 where contact is exact [mm]
};
ContactFigures contact_figures(const Model& model, const State& state, const PlateContact& contact,
                               int plate, const FaceList& faces,
                               const PlateFriction* friction = nullptr);

}  // namespace mammotwin
