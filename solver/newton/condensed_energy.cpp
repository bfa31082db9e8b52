#include "solver/newton/condensed_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mammotwin {

void CondensedEnergy::admit(const PressureStep& step) {
  constexpr double headroom = 2;  // more than 1 makes every Newton step a descent
  for (Eigen::Index e = 0; e < caps_.size(); ++e)
    caps_[e] = std::max(
        {caps_[e], headroom * step.after.col(e).norm(), headroom * step.now.col(e).norm()});
}

double CondensedEnergy::value(const Balance& balance) const {
  if (!std::isfinite(balance.energy)) return std::numeric_limits<double>::infinity();
  double sum = balance.stored;
  for (Eigen::Index e = 0; e < caps_.size(); ++e) {
    const double s = balance.swelling.col(e).norm(), cap = caps_[e];
    sum += s <= cap ? s * s / 2 : cap * (s - cap / 2);
  }
  return sum;
}

/// δ stored = work − p·C δx, and Lᵀp·rate = p·C δx.
double CondensedEnergy::slope(const Balance& balance, const PressureStep& step, double work) const {
  double sum = work;
  for (Eigen::Index e = 0; e < caps_.size(); ++e) {
    const double s = balance.swelling.col(e).norm();
    const double share = s <= caps_[e] ? 1 : caps_[e] / s;
    sum += (share * balance.swelling.col(e) - step.now.col(e)).dot(step.rate.col(e));
  }
  return sum;
}

double CondensedEnergy::rounding(const Balance& balance) {
  constexpr double of_a_sum = 64;  // units in the last place that sums over points lose
  return of_a_sum * std::numeric_limits<double>::epsilon() * balance.magnitude;
}

}  // namespace mammotwin
