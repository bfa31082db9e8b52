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

constexpr double kStepTolerance = 1e-3;  // of rounds after which a plate is still inside

class Finish {
 public:
  Finish(Press& press, double penalty) : press_(press), penalty_(penalty) {}
  NewtonReport run(State& state);

 private:
  struct Errors {
    double excess;     ///< penetration over the tolerance
    double inside;     ///< both plates' penetrations together [mm]
    double thickness;  ///< [mm]
    double tilt;       ///< [deg]
    bool off, leans;   ///< by more than the tolerance
    bool closed() const { return excess <= 1 && !leans; }
  };
  Errors errors(const State& state) const;
  static double left_by_closing(const Errors& now, double growth);
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
  const double support = press_.figures(state, Press::kSupport).penetration;
  const double paddle = press_.figures(state, Press::kPaddle).penetration;
  return {std::max(support, paddle) / options.gap_tolerance,
          support + paddle,
          thickness,
          tilt,
          std::abs(thickness) > options.thickness_tolerance,
          std::abs(tilt) > kTiltTolerance};
}

/// Error of thickness that a penalty `growth` times as stiff will not take away by itself [mm].
double Finish::left_by_closing(const Errors& now, double growth) {
  if (now.thickness <= 0) return now.thickness;
  return std::max(0.0, now.thickness - now.inside * (1 - 1 / growth));
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
    if (growth > 1) secant = {};  // stiffer contact changes the thickness, too
    const double error = left_by_closing(now, growth);
    const double most_move = round == 0 || soft ? std::abs(now.thickness) : far;
    const double move = std::abs(error) > press_.options().thickness_tolerance
                            ? secant.move(error, most_move)
                            : 0;
    const double tolerance = now.excess <= growth ? 0 : kStepTolerance;
    const bool good = better(state, [&](State& trial) {
      if (move != 0 || now.leans)
        press_.move_paddle(press_.placed().paddle_height + move,
                           press_.placed().paddle_tilt - (now.leans ? now.tilt / kTiltSlope : 0));
      if (soft || std::abs(move) > far) return press_.squeeze(trial, penalty_);
      press_.set_penalty(press_.penalty() * growth);
      return press_.resettle(trial, tolerance);
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
