#pragma once

#include <functional>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/element/solid_element.h"

namespace mammotwin {

/// Forces on a body that stay as they are while it moves, for each nodal parameter of each element
/// [mN per unit of the parameter]. Empty: none.
using DeadForces = std::vector<SolidElement::Coefficients>;

/// Pressure [kPa] on the skin at a point with its outward unit normal.
using SkinPressure =
    std::function<double(const Eigen::Vector3d& x, const Eigen::Vector3d& outward)>;

/// What `pressure` does to the skin of `shape` in that shape: -∫ p n N dA over its faces, by 8 x 8
/// Gauss points each.
DeadForces forces_of_pressure(const MeshFile& shape, const SkinPressure& pressure);

DeadForces scaled(DeadForces forces, double factor);

}  // namespace mammotwin
