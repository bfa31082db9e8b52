#include "solver/press/finish.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "solver/press/compression_figures.h"

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
  bool loose = true;
};

constexpr double kLoosely = 1e-2;  // residual of rounds
// Residual of the last state: under a hundredth of a mm. Below it friction's points can change
// between sticking and sliding for thirty iterations, and nothing else does.
constexpr double kSettled = 1e-4;
constexpr double kOnTheWay = 5e-2;  // residual of a state that is no balance and worth keeping
// Of the penalty in a round; 3 and more bring chatter.
constexpr double kLeastGrowth = 1.5, kMostGrowth = 2;
constexpr double kComesOut = 0.75;   // of what is inside a plate, in such a round
constexpr double kNearlyDone = 1.1;  // of a tolerance
constexpr double kNearly = 0.09;  // [mm]: an error with which a breast still counts as compressed
constexpr double kFar = 1;        // [mm]: stiff contact does not follow a paddle that moves by more

/// Rounds that each close contact further, by a stiffer penalty, move the paddle, or do both.
class Finish {
 public:
  Finish(Press& press, double thickness, double penalty, double let_go_below)
      : press_(press), thickness_(thickness), penalty_(penalty), let_go_below_(let_go_below) {}
  Finished run(State& state);

 private:
  struct Errors {
    double excess;     ///< of the mean gap over its tolerance
    double deep;       ///< deepest point over its tolerance
    double inside;     ///< both plates' mean gaps together [mm]
    double thickness;  ///< [mm]
    double tilt;       ///< [deg]
    bool off, leans;   ///< by more than the tolerance
    bool closed() const { return excess <= 1 && deep <= 1 && !leans; }
    bool near_enough() const {
      return std::max(excess, deep) <= kNearlyDone && std::abs(thickness) <= kNearly && !leans;
    }
  };
  Errors errors(const State& state) const;
  double imbalance(const State& state) const;
  void remember(const Errors& now, const State& state);
  Place here(const State& state) const;
  void go_back_to(const Place& place, State& state);
  bool better(State& state, const std::function<NewtonReport(State&)>& attempt);
  double move_for(const Errors& now, bool closing);
  bool improve(const Errors& now, bool closing, double growth, State& state);
  bool settle(State& state);

  Press& press_;
  const double thickness_, penalty_, let_go_below_;
  NewtonReport total_;
  ThicknessSecant secant_;
  bool closed_ = false;     ///< the last round closed contact further
  bool from_soft_ = false;  ///< the next round starts from the load steps' penalty again
  bool loose_ = true;       ///< the state is in balance to kLoosely only
  Place best_;
  double best_error_ = std::numeric_limits<double>::infinity();
};

Finish::Errors Finish::errors(const State& state) const {
  const CompressionOptions& options = press_.options();
  const double thickness = press_.thickness(state) - thickness_;
  const double tilt = press_.tilt_error(state);
  const ContactFigures support = press_.figures(state, Press::kSupport),
                       paddle = press_.figures(state, Press::kPaddle);
  const double gap = std::max(support.mean_gap, paddle.mean_gap),
               penetration = std::max(support.penetration, paddle.penetration);
  return {gap / options.gap_tolerance,
          penetration / Press::kDeepest,
          support.mean_gap + paddle.mean_gap,
          thickness,
          tilt,
          std::abs(thickness) > options.thickness_tolerance,
          std::abs(tilt) > kTiltTolerance};
}

/// Of the forces that flow.
double Finish::imbalance(const State& state) const {
  const Balance balance = press_.newton().balance(state);
  return balance.residual.norm() / balance.flow;
}

void Finish::remember(const Errors& now, const State& state) {
  const double error = std::abs(now.thickness);
  if (!(now.closed() || now.near_enough()) || error >= best_error_) return;
  best_ = here(state);
  best_error_ = error;
}

Place Finish::here(const State& state) const {
  return {state, press_.placed(), press_.penalty(), loose_};
}

void Finish::go_back_to(const Place& place, State& state) {
  state = place.state;
  press_.put(place.plates);
  press_.set_penalty(place.penalty);
  press_.track_friction(state);
  loose_ = place.loose;
}

/// Keeps what `attempt` does to the state, plates and contact only if it succeeds.
bool Finish::better(State& state, const std::function<NewtonReport(State&)>& attempt) {
  const Place before = here(state);
  const NewtonReport report = attempt(state);
  total_ = then(total_, report);
  if (report.usable())
    press_.track_friction(state);  // a round that failed inside may have left another's
  else
    go_back_to(before, state);
  return report.usable();
}

/// The paddle's way for what contact that is closing will not correct by itself [mm].
double Finish::move_for(const Errors& now, bool closing) {
  if (closing || closed_) secant_ = {};  // contact that closes changes the thickness, too
  closed_ = closing;
  const double left = now.thickness <= 0
                          ? now.thickness
                          : std::max(0.0, now.thickness - (closing ? kComesOut * now.inside : 0));
  if (std::abs(left) <= press_.options().thickness_tolerance) return 0;
  return secant_.move(left, closing || from_soft_ ? std::abs(now.thickness) : kFar);
}

bool Finish::improve(const Errors& now, bool closing, double growth, State& state) {
  const double move = move_for(now, closing);
  return better(state, [&](State& trial) {
    if (move != 0 || now.leans)
      press_.move_paddle(press_.placed().paddle_height + move,
                         press_.placed().paddle_tilt - (now.leans ? now.tilt / kTiltSlope : 0));
    loose_ = true;
    if (from_soft_ || std::abs(move) > kFar) return press_.squeeze(trial, penalty_);
    press_.set_penalty(press_.penalty() * growth);
    return press_.resettle(trial, kLoosely);
  });
}

/// False where the state finds no balance, or none that is stable, with contact as it is. What lies
/// on an edge falls, farther than one solve goes: the next begins where that one ended.
bool Finish::settle(State& state) {
  if (!loose_) return true;
  const Place before = here(state);
  const NewtonReport report = press_.resettle(state, kSettled);
  total_ = then(total_, report);
  if (report.usable())
    loose_ = false;
  else if (!(report.residual <= kOnTheWay))
    go_back_to(before, state);
  press_.track_friction(state);
  return report.usable();
}

Finished Finish::run(State& state) {
  constexpr int most_rounds = 16;
  constexpr double headroom = 1.2;
  // Skin between contact points snaps from one place to another, and the extent with it.
  constexpr int patience = 4;
  // At another penalty points do not circle, or settle into a minimum.
  constexpr int most_unsettled = 2;
  double most_growth = kMostGrowth;
  int unsettled = 0;
  for (int round = 0, closed = 0; round < most_rounds; ++round) {
    Errors now = errors(state);
    bool settled = true;
    if (now.closed() && !now.off && loose_) {
      settled = settle(state);
      if (!settled && retained_fraction(press_, state) < let_go_below_) return {total_, true};
      now = errors(state);
    }
    if (now.closed() && !now.off && (settled || ++unsettled > most_unsettled)) return {total_};
    remember(now, state);
    if (now.closed() && ++closed >= patience && best_error_ <= kNearly) break;
    const bool closing = now.excess > 1 || now.deep > 1 || !settled;
    const double growth = closing ? std::clamp(headroom * std::max(now.excess, now.deep),
                                               std::min(kLeastGrowth, most_growth), most_growth)
                                  : 1;
    const bool good = improve(now, closing, growth, state);
    if (!good && !std::isfinite(best_error_) && retained_fraction(press_, state) < let_go_below_)
      return {total_, true};
    const bool stuck = !good && growth == 1;
    if (!good && (from_soft_ || (stuck && now.near_enough()))) break;
    from_soft_ = stuck;
    if (good) continue;
    most_growth = growth > kLeastGrowth ? std::max(kLeastGrowth, std::sqrt(growth)) : 1;
    secant_ = {};
  }
  if (std::isfinite(best_error_)) go_back_to(best_, state);
  const Place last = here(state);
  const double out_of_balance = imbalance(state);
  if (!settle(state) && !(imbalance(state) < out_of_balance && errors(state).near_enough()))
    go_back_to(last, state);
  return {total_};
}

}  // namespace

Finished finish_compression(Press& press, double thickness, double penalty, double let_go_below,
                            State& state) {
  return Finish(press, thickness, penalty, let_go_below).run(state);
}

}  // namespace mammotwin
