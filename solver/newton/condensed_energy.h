#pragma once

#include <Eigen/Core>

#include "solver/newton/assembler.h"

namespace mammotwin {

/// Merit of a shape x, whatever its pressures are at the moment: the total potential with the
/// pressures eliminated exactly, element by element,
///
///     E(x) = stored(x) + Σₑ φ(|sₑ|),   s = L⁻¹ ∫ψ (J − 1), ∫ψψᵀ/κ = L Lᵀ
///     φ(s) = s²/2 up to a cap c, c s − c²/2 beyond
///
/// where |s| is the element's pressure that belongs to x, |Lᵀp|. Every equilibrium is a stationary
/// point of E, and the stable ones are its minima, once the caps lie above the pressures there. The
/// caps are what lets Newton's steps be long: with the whole s² a volume error of 1e-2 costs more
/// than all shear at κ/μ = 1e4, and load steps become as many as with a pure penalty (48 instead
/// of one; solver_study, section 1). With φ the merit is an exact penalty function (Nocedal and
/// Wright, Numerical Optimization, section 15.4 and 18.3).
class CondensedEnergy {
 public:
  explicit CondensedEnergy(int elements) : caps_(Eigen::VectorXd::Zero(elements)) {}

  void forget() { caps_.setZero(); }

  /// Raises the caps above the pressures that a step asks for; they sink only when forgotten.
  void admit(const PressureStep& step);

  double value(const Balance& balance) const;  ///< [mN mm]; infinite where an element is inverted

  /// Along δx, whose product with the residual is `work`, at the step's start [mN mm].
  double slope(const Balance& balance, const PressureStep& step, double work) const;

  /// Differences of `value` below this are rounding [mN mm].
  static double rounding(const Balance& balance);

 private:
  Eigen::VectorXd caps_;  ///< [√(mN mm)]
};

}  // namespace mammotwin
