#pragma once

#include <functional>

namespace mammotwin {

struct State;

/// How what the energy holds fixed during a Newton step, such as friction's pressures, is brought
/// up to the state. All empty: nothing is.
struct Following {
  /// To a state, an accepted one or one that is tried; with a share below 1 only so far from what
  /// is held.
  std::function<void(const State&, double share)> refresh;
  std::function<void(const State& from, const State& to)> step;  ///< after each accepted step
  std::function<void()> end;                                     ///< of the solve
  explicit operator bool() const { return bool(refresh); }
};

}  // namespace mammotwin
