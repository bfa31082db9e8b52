#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "solver/contact/plate.h"
#include "solver/element/surface_potential.h"
#include "solver/newton/following.h"

namespace mammotwin {

/// Frictionless contact with rigid plates, a penalty (paper, eq. 8) augmented by multipliers λ, per
/// reference area:
///
///     energy = Σ_plates t²/(2ε),   pressure t = ⟨λ − ε gap⟩
///
/// λ is what a point is pressed with before it is inside. Fixed while Newton solves, it leaves a
/// potential like any other; where it is the pressure, the gap is closed at whatever ε (Simo,
/// Laursen, Computers & Structures 42 (1992), section 2). Without λ this is the penalty alone. In
/// both cases with the exact tangent (normal and curvature of the plate) unless `with_curvature` is
/// off. Far from equilibrium, just after ε was raised, t is the violation's and not the tissue's,
/// and its product with an edge's curvature makes the tangent indefinite at J = 1. The driver moves
/// the plates and continues ε (penalty_continuation.h).
class PlateContact : public SurfacePotential {
 public:
  std::vector<Plate> plates;
  double penalty = 1;          ///< ε [kPa/mm]
  int points1d = 5;            ///< Gauss points a side on the faces in contact
  bool with_curvature = true;  ///< t ∂²gap/∂x² in the tangent
  Following follow;            ///< friction's; empty: no friction, or frozen

  std::vector<double> multipliers;  ///< λ by surface point, then plate [kPa]; empty: 0

  /// t of a surface point with a plate [kPa].
  double pressure(double gap, const SurfacePoint& point, std::size_t plate) const {
    const double multiplier =
        multipliers.empty() ? 0 : multipliers[point.index * plates.size() + plate];
    return std::max(0.0, multiplier - penalty * gap);
  }

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override;
};

}  // namespace mammotwin
