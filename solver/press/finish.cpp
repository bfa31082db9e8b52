#include "solver/press/finish.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace mammotwin {

namespace {

/// Paddle moves that bring the thickness to the one asked: where only the plates' edges press, the
/// breast's extent follows the paddle by a fraction.
class ThicknessSecant {
 public:
  double move(double error, double most) {
    constexpr double least_slope = 0.15, most_slope = 4;
    if (last_move_ != 0)
      slope_ = std::clamp((error - last_error_) / last_move_, least_slope, most_slope);
    last_error_ = error;
    return last_move_ = std::clamp(-error / slope_, -most, most);
  }

 private:
  double slope_ = 1, last_move_ = 0, last_error_ = 0;
};

struct Place {
  State state;
  PlacedPlates plates;
  double penalty = 0;
};

class Finish {
 public:
  Finish(Press& press, double penalty) : press_(press), penalty_(penalty) {}
  NewtonReport run(State& state);

 private:
  struct Errors {
    double excess;     ///< penetration over the tolerance
    double thickness;  ///< [mm]
    double tilt;       ///< [deg]
    bool off, leans;   ///< by more than the tolerance
    bool closed() const { return excess <= 1 && !leans; }
  };
  Errors errors(const State& state) const;
  void go_back_to(const Place& place, State& state);
  bool better(State& state, const std::function<NewtonReport(State&)>& attempt);

  Press& press_;
  const double penalty_;
  NewtonReport total_;
};

Finish::Errors Finish::errors(const State& state) const {
  const CompressionOptions& options = press_.options();
  const double thickness = press_.thickness(state) - press_.problem().plates.thickness;
  const double tilt = press_.tilt_error(state);
  return {press_.penetration(state) / options.gap_tolerance, thickness, tilt,
          std::abs(thickness) > options.thickness_tolerance, std::abs(tilt) > kTiltTolerance};
}

void Finish::go_back_to(const Place& place, State& state) {
  state = place.state;
  press_.put(place.plates);
  press_.set_penalty(place.penalty);
  press_.track_friction(state);
}

/// Keeps what `attempt` does to the state, plates and penalty only if it succeeds.
bool Finish::better(State& state, const std::function<NewtonReport(State&)>& attempt) {
  const Place before{state, press_.placed(), press_.penalty()};
  const NewtonReport report = attempt(state);
  total_ = then(total_, report);
  if (report.usable())
    press_.track_friction(state);  // a round that failed inside may have left another's
  else
    go_back_to(before, state);
  return report.usable();
}

NewtonReport Finish::run(State& state) {
  constexpr int most_rounds = 16;
  constexpr double least_growth = 1.5, most_growth = 5, headroom = 1.2;
  constexpr double far = 1;  // [mm]: stiff contact does not follow a paddle that moves by more
  // Skin between contact points snaps from one place to another, and the extent with it.
  constexpr int patience = 4;
  constexpr double nearly = 0.09;  // [mm]
  double most = most_growth, best_error = std::numeric_limits<double>::infinity();
  bool soft = false;
  ThicknessSecant secant;
  Place best;
  for (int round = 0, closed = 0; round < most_rounds; ++round) {
    const Errors now = errors(state);
    if (now.closed() && !now.off) return total_;
    if (now.closed()) {
      if (std::abs(now.thickness) < best_error) {
        best = {state, press_.placed(), press_.penalty()};
        best_error = std::abs(now.thickness);
      }
      if (++closed >= patience && best_error <= nearly) break;
    }
    const double growth =
        now.excess <= 1 ? 1 : std::clamp(headroom * now.excess, least_growth, most);
    const double most_move = round == 0 || soft ? std::abs(now.thickness) : far;
    const double move = now.off ? secant.move(now.thickness, most_move) : 0;
    const bool good = better(state, [&](State& trial) {
      if (now.off || now.leans)
        press_.move_paddle(press_.placed().paddle_height + move,
                           press_.placed().paddle_tilt - (now.leans ? now.tilt / kTiltSlope : 0));
      if (soft || std::abs(move) > far) return press_.squeeze(trial, penalty_);
      press_.set_penalty(press_.penalty() * growth);
      return press_.resettle(trial);
    });
    if (!good && soft) break;
    soft = !good && (growth == 1 || most <= least_growth);
    if (!good) most = std::max(least_growth, std::sqrt(most));
    if (!good) secant = {};
  }
  if (std::isfinite(best_error)) go_back_to(best, state);
  return total_;
}

}  // namespace

NewtonReport finish_compression(Press& press, double penalty, State& state) {
  return Finish(press, penalty).run(state);
}

}  // namespace mammotwin
