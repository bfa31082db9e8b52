#pragma once

#include <cmath>
#include <limits>

#include "solver/newton/model.h"

namespace mammotwin {

/// The state of a solve that was nearest to balance, and how long ago that was. Where friction is
/// followed there is no merit that only falls, and points that turn from sticking to sliding and
/// back can go on for ever.
class Nearest {
 public:
  void forget() { residual_ = std::numeric_limits<double>::infinity(); }

  void note(const State& state, double residual, int iteration) {
    if (residual > kNoticeably * residual_) return;
    state_ = state;
    residual_ = residual;
    iteration_ = iteration;
  }

  /// Whether many iterations came no nearer.
  bool long_ago(int iteration) const {
    return std::isfinite(residual_) && iteration - iteration_ >= kPatience;
  }

  const State& state() const { return state_; }
  double residual() const { return residual_; }

 private:
  static constexpr int kPatience = 15;        ///< iterations
  static constexpr double kNoticeably = 0.9;  ///< of a residual: nearer

  State state_;
  double residual_ = std::numeric_limits<double>::infinity();
  int iteration_ = 0;
};

}  // namespace mammotwin
