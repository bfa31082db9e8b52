#include "solver/gravity/fit_stiffness.h"

#include <cmath>
#include <limits>

namespace mammotwin {

namespace {

constexpr double kLowest = 0.1, kHighest = 10, kPrecision = 0.02;

/// Distance from the second state with stiffnesses times `factor`; infinite without convergence.
double distance_with(double factor, BreastProblem prone, const Eigen::Vector3d& second_gravity,
                     const StateDistance& distance, UnloadOptions options) {
  options.check = false;
  prone.gravity /= factor;
  const UnloadResult unloaded = unload(prone, options);
  if (!unloaded.report.usable()) return std::numeric_limits<double>::infinity();
  BreastProblem second = from_unloaded(prone, unloaded.unloaded);
  second.gravity = second_gravity / factor;
  second.pressed = {};
  HangOptions hanging;
  hanging.solid = options.solid;
  const HangResult state = hang(second, hanging);
  return state.report.usable() ? distance(state.deformed) : std::numeric_limits<double>::infinity();
}

}  // namespace

StiffnessFit fit_stiffness(const BreastProblem& prone, const Eigen::Vector3d& second_gravity,
                           const StateDistance& distance, const UnloadOptions& options,
                           const Progress& progress) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const double width = std::log(kHighest / kLowest);
  const int most = static_cast<int>(std::ceil(std::log(kPrecision / width) / std::log(golden)));
  StiffnessFit fit;
  const auto at = [&](double log_factor) {
    if (progress) progress(fit.trials / (most + 3.0), "fitting stiffness to the second state");
    ++fit.trials;
    return distance_with(std::exp(log_factor), prone, second_gravity, distance, options);
  };
  fit.distance_at_one_mm = at(0);
  double low = std::log(kLowest), high = std::log(kHighest);
  double left = high - golden * (high - low), right = low + golden * (high - low);
  double at_left = at(left), at_right = at(right);
  for (int k = 0; k < most; ++k) {
    // Two infinite values: both are too soft.
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      at_left = at(left = high - golden * (high - low));
    } else {
      low = left, left = right, at_left = at_right;
      at_right = at(right = low + golden * (high - low));
    }
  }
  fit.factor = std::exp(at_left < at_right ? left : right);
  fit.distance_mm = std::min(at_left, at_right);
  const double end = std::exp(kPrecision);
  if (!std::isfinite(fit.distance_mm))
    fit.reason = "no stiffness factor from 0.1 to 10 gives a breast that comes to rest";
  else if (fit.factor < kLowest * end || fit.factor > kHighest / end)
    fit.reason = "the second state asks for a stiffness factor beyond 0.1 to 10";
  return fit;
}

}  // namespace mammotwin
