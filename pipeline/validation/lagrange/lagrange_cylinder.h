#pragma once

#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

namespace mammotwin {

/// The lateral or plane-strain gel cylinder on Lagrange elements over the same element grid: order
/// 1, trilinear with constant pressure, or 2, triquadratic with linear discontinuous pressure. Same
/// law, plates and gap tolerance as squeeze_cylinder, the penalty raised from soft, in one load
/// step. Throws std::invalid_argument for other cases, orders or parts.
CylinderFigures squeeze_lagrange_cylinder(const CylinderExperiment& experiment, int order);

}  // namespace mammotwin
