#include "solver/press/one_press.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "solver/load/load_stepping.h"
#include "solver/press/checkpoint.h"
#include "solver/press/come_to_rest.h"
#include "solver/press/compression_figures.h"
#include "solver/press/finish.h"
#include "solver/press/judge_compressed.h"
#include "solver/press/plate_way.h"
#include "solver/press/press.h"
#include "solver/press/solution_fields.h"

namespace mammotwin {

namespace {

constexpr double kStepGrowth = 1.5;
// Of the longest move: a longer step whose extrapolated state finds no equilibrium is halved, which
// costs less than pressing softly from the state before.
constexpr double kHalved = 0.3;

State extrapolated(const State& now, const State& before, double ahead) {
  State then = now;
  for (std::size_t i = 0; i < now.x.size(); ++i) then.x[i] += ahead * (now.x[i] - before.x[i]);
  for (std::size_t i = 0; i < now.pressure.size(); ++i)
    then.pressure[i] += ahead * (now.pressure[i] - before.pressure[i]);
  return then;
}

/// One compression under way: the load steps along the plates' way.
class Compression {
 public:
  Compression(const CompressionProblem& problem, const CompressionOptions& options,
              double let_go_below, const Progress& progress, const CompressionRestart& restart);
  CompressionResult run();
  CompressionResult run_from(const CompressionResult& near);

 private:
  bool begin(State& state);
  bool settle(State& state);
  void place(double fraction);
  NewtonReport balance_tilt(NewtonReport report, State& state);
  NewtonReport equilibrate(double fraction, State& state);
  void record(const LoadSteppingReport& load, const State& state, const NewtonReport& newton);
  LoadSteppingReport close_plates(State& state);
  void finish(double penalty, State& state);
  CompressionResult result_at(const State& state) const;
  void count(const NewtonReport& newton);
  bool too_hard(const State& state);
  void stop_by_force(const LoadSteppingReport& pressed, State& state);

  const CompressionProblem& problem_;
  const CompressionOptions& options_;
  const double let_go_below_;
  const Progress progress_;
  const CompressionRestart restart_;
  Press press_;
  PlateWay way_;
  CompressionCheckpoint good_;  ///< the last good step
  std::optional<double> stop_;  ///< thickness at which the most force was reached [mm]
  bool lost_ = false;           ///< the breast has slipped out, or is let go
  CompressionReport report_;
};

Compression::Compression(const CompressionProblem& problem, const CompressionOptions& options,
                         double let_go_below, const Progress& progress,
                         const CompressionRestart& restart)
    : problem_(problem),
      options_(options),
      let_go_below_(let_go_below),
      progress_(progress),
      restart_(restart),
      press_(problem, options),
      way_(press_.frame(), problem, options.moving) {
  good_.tilt = problem.plates.paddle_tilt;
  report_.target_thickness_mm = problem.plates.thickness;
  report_.free_thickness_mm = press_.frame().free_extent();
  report_.dof = press_.breast().dofs->num_equations();
}

/// At the end of the way the paddle goes farther by how much tissue stood inside the plates in the
/// last step: the breast is to be so thick, not the plates so far apart.
void Compression::place(double fraction) {
  constexpr double most = 2;  // [mm]
  press_.put(way_.at(fraction, good_.tilt));
  const auto& last = good_.reached.fraction < 1 ? good_.reached : good_.before;
  if (fraction < 1 || last.fraction == 0) return;
  const PlacedPlates placed = way_.at(last.fraction, good_.tilt);
  const double apart = placed.paddle_height - placed.support_height;
  const double inside = std::clamp(press_.thickness(last.state) - apart, 0.0, most);
  press_.move_paddle(press_.placed().paddle_height - inside, good_.tilt);
}

/// Turns the paddle by the secant method until its spring and the breast are in balance.
NewtonReport Compression::balance_tilt(NewtonReport report, State& state) {
  constexpr int most_rounds = 10;
  constexpr double most_turn = 4, most_tilt = 30;  // [deg]
  constexpr double least_slope = -0.5;
  double slope = kTiltSlope;
  for (int round = 0; report.usable() && round < most_rounds; ++round) {
    const double error = press_.tilt_error(state), tilt = press_.placed().paddle_tilt;
    if (std::abs(error) <= kTiltTolerance) return report;
    const double turn = std::clamp(-error / slope, -most_turn, most_turn);
    if (std::abs(tilt + turn) > most_tilt) break;
    press_.move_paddle(press_.placed().paddle_height, tilt + turn);
    report = then(report, press_.squeeze(state, good_.penalty));
    slope = std::min((press_.tilt_error(state) - error) / turn, least_slope);
  }
  if (report.usable()) report.reason = "the paddle's tilt finds no balance with its spring";
  report.converged = false;
  return report;
}

/// From the last two steps extrapolated; where a short step fails so, from the last.
NewtonReport Compression::equilibrate(double fraction, State& state) {
  if (lost_ || stop_) return {};  // pressing on what is left would tell nothing
  const auto attempt = [&](State& trial, bool near) {
    place(fraction);
    press_.restore_friction(good_.sticking);
    return balance_tilt(press_.squeeze(trial, good_.penalty, near), trial);
  };
  NewtonReport tried;
  const double last = good_.reached.fraction - good_.before.fraction;
  if (last > 0) {
    State trial =
        extrapolated(state, good_.before.state, (fraction - good_.reached.fraction) / last);
    tried = attempt(trial, true);
    if (tried.usable()) {
      state = std::move(trial);
      return tried;
    }
    const double move = (fraction - good_.reached.fraction) * way_.longest();
    if (move > kHalved * options_.longest_move) return tried;
  }
  return then(tried, attempt(state, false));
}

void Compression::count(const NewtonReport& newton) {
  report_.newton_iterations += newton.iterations;
  report_.indefinite_matrices += newton.indefinite;
}

void Compression::record(const LoadSteppingReport& load, const State& state,
                         const NewtonReport& newton) {
  if (too_hard(state)) return;
  const Balance balance = press_.newton().balance(state);
  report_.history.push_back({press_.thickness(state), press_.paddle_force(state), newton.iterations,
                             press_.penalty(), balance.min_J, balance.max_J, state.x});
  good_.load = load;
  good_.before = std::exchange(good_.reached, {load.reached, state});
  good_.tilt = press_.placed().paddle_tilt;
  good_.penalty = press_.penalty();
  good_.sticking = press_.commit_friction(state);
  good_.report = report_;
  lost_ = slipped_out(press_, state);
  if (restart_.keep && !report_.stopped_by_force) restart_.keep(good_);
  if (progress_)
    progress_(0.95 * load.reached, "compressed to " + in_mm(report_.history.back().thickness_mm));
}

/// Whether the paddle presses harder than it may; then `stop_` is where it came to that, by the
/// force's logarithm between two steps.
bool Compression::too_hard(const State& state) {
  const double force = press_.paddle_force(state), most = problem_.most_force;
  if (report_.stopped_by_force || force <= most) return false;
  const double before = report_.history.empty() ? 0 : report_.history.back().force_N;
  const double from = press_.thickness(good_.reached.state);
  // From the first touch the force grows about with the square of the way.
  const double share =
      before > 0 ? std::log(most / before) / std::log(force / before) : std::sqrt(most / force);
  stop_ = from + share * (press_.thickness(state) - from);
  return true;
}

/// Back to the last good step, from which the way ends where the force is reached.
void Compression::stop_by_force(const LoadSteppingReport& pressed, State& state) {
  report_.target_thickness_mm = *stop_;
  report_.stopped_by_force = true;
  constexpr double least = 1e-3;  // of the way
  const double end = std::max({least, way_.fraction_at(*stop_), good_.reached.fraction});
  way_.end_at(end);
  for (double* fraction : {&good_.before.fraction, &good_.reached.fraction, &good_.load.reached})
    *fraction /= end;
  good_.load.next_step = 1 - good_.load.reached;
  good_.load.iterations = pressed.iterations;
  good_.load.indefinite = pressed.indefinite;
  state = good_.reached.state;
  place(good_.reached.fraction);
  press_.set_penalty(good_.penalty);
  press_.restore_friction(good_.sticking);
  stop_.reset();
}

/// Brings the breast to rest, the plates away; false where it does not come to rest.
bool Compression::settle(State& state) {
  press_.put(way_.start());
  press_.take_plates_away();
  const LoadSteppingReport load = come_to_rest(problem_, press_.breast(), press_.newton(), state);
  report_.newton_iterations += load.iterations;
  report_.indefinite_matrices += load.indefinite;
  if (!load.complete()) report_.reason = "does not come to rest under gravity: " + load.reason;
  return load.complete();
}

/// The state from which the plates close: at rest, or that of a checkpoint.
bool Compression::begin(State& state) {
  state = press_.model().rest();
  if (!restart_.from) {
    if (!settle(state)) return false;
    place(0);
    good_.found = state.x;
    good_.reached = {0, state};
    good_.sticking = press_.commit_friction(state);
    return true;
  }
  good_ = *restart_.from;
  const State& reached = good_.reached.state;
  if (reached.x.size() != state.x.size() || reached.pressure.size() != state.pressure.size())
    throw std::invalid_argument("the checkpoint is of another mesh");
  state = reached;
  report_.history = good_.report.history;
  report_.newton_iterations = good_.report.newton_iterations;
  report_.indefinite_matrices = good_.report.indefinite_matrices;
  place(good_.reached.fraction);
  press_.set_penalty(good_.penalty);
  press_.restore_friction(good_.sticking);
  lost_ = slipped_out(press_, state);
  return true;
}

void Compression::finish(double penalty, State& state) {
  const Finished finished =
      finish_compression(press_, report_.target_thickness_mm, penalty, let_go_below_, state);
  count(finished.effort);
  lost_ = finished.let_go;
}

LoadSteppingReport Compression::close_plates(State& state) {
  const double longest = std::min(1.0, options_.longest_move / way_.longest());
  const LoadSteppingReport load = step_load(
      state,
      {std::min(longest, options_.first_step), longest * options_.smallest_step,
       options_.max_iterations, kStepGrowth, longest},
      [&](double fraction, State& s) { return equilibrate(fraction, s); },
      [&](const LoadSteppingReport& so_far, const State& s, const NewtonReport& n) {
        record(so_far, s, n);
      },
      good_.load);
  if (stop_) return load;
  report_.steps = load.steps;
  report_.cutbacks = load.cutbacks;
  report_.newton_iterations += load.iterations;
  report_.indefinite_matrices += load.indefinite;
  if (load.complete() && !lost_)
    finish(good_.penalty, state);
  else
    place(load.reached);
  return load;
}

CompressionResult Compression::result_at(const State& state) const {
  return {
      state.x, good_.found, state.pressure, press_.placed(), press_.penalty(), press_.holds(state),
      {},      report_};
}

CompressionResult Compression::run() {
  const auto start = std::chrono::steady_clock::now();
  State state;
  if (!begin(state)) return {state.x, state.x, state.pressure, press_.placed(), 0, {}, {}, report_};
  LoadSteppingReport load = close_plates(state);
  if (stop_) {
    stop_by_force(load, state);
    load = close_plates(state);
  }
  measure_compression(press_, state, report_);
  report_.slipped_out = report_.slipped_out || lost_;
  judge_compressed(press_, load, state, report_);
  if (report_.usable()) report_.energy_force_N = force_from_energy(press_, state);
  report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (progress_) progress_(1, "compressed to " + in_mm(report_.thickness_mm));
  CompressionResult result = result_at(state);
  if (report_.usable()) result.fields = solution_fields(press_, state);
  return result;
}

/// The plates go at once to their new places, as far apart beyond the thickness as they were.
CompressionResult Compression::run_from(const CompressionResult& near) {
  State state = press_.model().rest();
  if (near.deformed.size() != state.x.size() || near.pressure.size() != state.pressure.size())
    throw std::invalid_argument("the result to start from belongs to another mesh");
  state.x = near.deformed;
  state.pressure = near.pressure;
  good_.found = near.found;
  const double apart = near.plates.paddle_height - near.plates.support_height;
  place(1);
  press_.move_paddle(press_.placed().support_height + problem_.plates.thickness + apart -
                         near.report.target_thickness_mm,
                     good_.tilt);
  press_.hold_by_friction(near.holds, state);
  NewtonReport newton = press_.squeeze(state, near.penalty);
  if (newton.usable()) newton = then(newton, press_.resettle(state));
  count(newton);
  LoadSteppingReport load;
  load.reached = newton.usable() ? 1 : 0;
  load.reason = newton.reason;
  if (load.complete()) finish(press_.penalty(), state);
  measure_compression(press_, state, report_);
  judge_compressed(press_, load, state, report_);
  return result_at(state);
}

}  // namespace

CompressionResult press_once(const CompressionProblem& problem, const CompressionOptions& options,
                             double let_go_below, const Progress& progress,
                             const CompressionRestart& restart) {
  return Compression(problem, options, let_go_below, progress, restart).run();
}

CompressionResult press_from(const CompressionResult& near, const CompressionProblem& problem,
                             const CompressionOptions& options) {
  return Compression(problem, options, 0, {}, {}).run_from(near);
}

}  // namespace mammotwin
