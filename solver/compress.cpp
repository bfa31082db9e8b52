#include "solver/compress.h"

#include "fitting/mesh/jacobian_bound.h"
#include "solver/breast_model.h"
#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/element/tensor_basis.h"
#include "solver/hang.h"
#include "solver/load/load_stepping.h"
#include "solver/material/neo_hookean.h"
#include "solver/newton/newton.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mammotwin {

namespace {

constexpr double kStepGrowth = 1.5;
constexpr double kStepTolerance = 1e-2;  // of load steps before the last
constexpr double kNearlyClosed = 0.5;  // [mm] penetration that a load step may leave: far less than
                                       // an edge's rounding, so that tissue keeps to its side
constexpr double kNewtonPerMilli = 1e-3;  // mN to N
constexpr double kCm2PerMm2 = 1e-2;
constexpr double kTiltTolerance = 0.05;   // [deg]
constexpr double kTiltSlope = -1.5;       // of moment / spring − tilt over tilt: a first guess

std::string in_mm(double length) {
  std::ostringstream text;
  text.precision(4);
  text << length << " mm";
  return text.str();
}

State extrapolated(const State& now, const State& before, double ahead) {
  State then = now;
  for (std::size_t i = 0; i < now.x.size(); ++i) then.x[i] += ahead * (now.x[i] - before.x[i]);
  for (std::size_t i = 0; i < now.pressure.size(); ++i)
    then.pressure[i] += ahead * (now.pressure[i] - before.pressure[i]);
  return then;
}

void check_shape(const HermiteMesh& mesh) {
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (!mesh.node(node).allFinite())
      throw std::invalid_argument("node " + std::to_string(node) +
                                  " of the mesh has a parameter that is not a finite number");
  if (!proved_valid(mesh))
    throw std::invalid_argument("the mesh is folded: det dX/dxi is not positive everywhere");
}

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

/// One compression under way.
class Compression {
 public:
  Compression(const CompressionProblem& problem, const CompressionOptions& options,
              const Progress& progress);
  CompressionResult run();

 private:
  void check_thickness() const;
  bool settle(State& state);
  void place(double fraction);
  void move_paddle(double height, double tilt);
  void put(const PlacedPlates& placed);
  double tilt_error(const State& state) const;
  NewtonReport balance_tilt(NewtonReport report, State& state);
  double penetration(const State& state) const;
  enum PlateNumber { kSupport, kPaddle };
  ContactFigures figures(const State& state, PlateNumber plate) const;
  double paddle_force(const State& state) const;
  void track_friction(const State& state);
  void end_step(const State& state);
  NewtonReport equilibrate(double fraction, State& state);
  double longest_way() const;
  NewtonReport squeeze(State& state);
  void finish(State& state);
  bool better(State& state, const std::function<NewtonReport(State&)>& attempt);
  void record(double fraction, const State& state, const NewtonReport& newton);
  double energy_force(const State& state);
  double volume_in_front(const State& state) const;
  void summarise(const State& state);
  void judge(const LoadSteppingReport& load);
  double wall_gap(const State& state) const;

  const CompressionProblem& problem_;
  const CompressionOptions& options_;
  const Progress& progress_;
  BreastModel breast_;
  PlateFrame frame_;
  Newton newton_;
  PlacedPlates start_, end_, placed_;
  PenaltyOptions penalties_;
  double tilt_;                      ///< of the paddle at the last good step [deg]
  struct GoodStep {
    double fraction = 0;
    State state;
  };
  struct Found {
    double error = std::numeric_limits<double>::infinity();  ///< of the thickness [mm]
    State state;
    PlacedPlates plates;
    double penalty = 0;
  };
  NewtonOptions exact_;      ///< of the last equilibrium
  GoodStep before_, reached_;  ///< the last two good steps
  double penalty_ = 0;       ///< of the last good step [kPa/mm]; 0: none yet
  PlateFriction::History sticking_;  ///< at the last good step
  CompressionReport report_;
};

Compression::Compression(const CompressionProblem& problem, const CompressionOptions& options,
                         const Progress& progress)
    : problem_(problem),
      options_(options),
      progress_(progress),
      breast_(make_breast_model(problem, options.solid)),
      frame_(problem.mesh, problem.plates),
      newton_(*breast_.model, *breast_.dofs) {
  check_thickness();
  penalties_.newton.tolerance = penalties_.newton.constraint_tolerance =
      penalties_.newton.acceptable = kStepTolerance;
  if (breast_.friction) breast_.contact->follow = [this](const State& s) { track_friction(s); };
  const double half = problem.plates.thickness / 2;
  const double middle = frame_.centroid_height() + problem.plates.lift;
  const auto [low, high] = frame_.touching_heights();
  tilt_ = problem.plates.paddle_tilt;
  end_ = frame_.place(middle - half, middle + half, tilt_);
  const bool beside = middle <= low || middle >= high;
  if (beside || (middle - half <= low && middle + half >= high))
    throw std::invalid_argument("plates never touch: the breast reaches from " + in_mm(low) +
                                " to " + in_mm(high) + " between plates at " +
                                in_mm(middle - half) + " and " + in_mm(middle + half));
  start_ = frame_.place(std::min(low, middle - half), std::max(high, middle + half), tilt_);
  report_.target_thickness_mm = problem.plates.thickness;
  report_.free_thickness_mm = frame_.extent(problem.mesh.mesh.nodes());
  report_.dof = breast_.dofs->num_equations();
}

void Compression::check_thickness() const {
  const double thickness = problem_.plates.thickness;
  const double extent = frame_.extent(problem_.mesh.mesh.nodes());
  if (!(std::isfinite(thickness) && thickness > 0 && thickness < extent))
    throw std::invalid_argument("thickness is " + in_mm(thickness) +
                                "; expected between 0 and the breast's own " + in_mm(extent) +
                                " along the beam");
}

void Compression::place(double fraction) {
  double support = fraction, paddle = fraction;
  if (options_.moving == Moving::paddle) {
    const double lift = end_.support_height - start_.support_height;
    const double share = lift / (lift + start_.paddle_height - end_.paddle_height);
    support = fraction < share ? fraction / share : 1;
    paddle = fraction < share ? 0 : (fraction - share) / (1 - share);
  }
  const auto between = [](double a, double b, double f) { return a + f * (b - a); };
  put(frame_.place(between(start_.support_height, end_.support_height, support),
                   between(start_.paddle_height, end_.paddle_height, paddle), tilt_));
}

void Compression::move_paddle(double height, double tilt) {
  put(frame_.place(placed_.support_height, height, tilt));
}

void Compression::put(const PlacedPlates& placed) {
  placed_ = placed;
  breast_.contact->plates = {placed_.support, placed_.paddle};
}

/// Of the plates, the longer one of two that move together, to their places in the end [mm].
double Compression::longest_way() const {
  const double support = end_.support_height - start_.support_height;
  const double paddle = start_.paddle_height - end_.paddle_height;
  return options_.moving == Moving::paddle ? support + paddle : std::max(support, paddle);
}

/// By how much the spring would have the paddle tilt further [deg]; 0 for a rigid one.
double Compression::tilt_error(const State& state) const {
  const PlateOptions& plates = problem_.plates;
  if (std::isinf(plates.tilt_spring)) return 0;
  const ContactFigures paddle = figures(state, kPaddle);
  const Eigen::Vector3d pivot =
      placed_.paddle.point + (plates.pivot - plates.rounding) * placed_.paddle.depth;
  const double moment =
      plates.depth.cross(plates.up).dot(paddle.moment - pivot.cross(paddle.force));
  return plates.paddle_tilt + moment / plates.tilt_spring - placed_.paddle_tilt;
}

/// Turns the paddle by the secant method until its spring and the breast are in balance.
NewtonReport Compression::balance_tilt(NewtonReport report, State& state) {
  constexpr int most_rounds = 10;
  constexpr double most_turn = 4, most_tilt = 30, least_slope = -0.5;  // [deg], [deg], [-]
  double slope = kTiltSlope;
  for (int round = 0; report.usable() && round < most_rounds; ++round) {
    const double error = tilt_error(state), tilt = placed_.paddle_tilt;
    if (std::abs(error) <= kTiltTolerance) return report;
    const double turn = std::clamp(-error / slope, -most_turn, most_turn);
    if (std::abs(tilt + turn) > most_tilt) break;
    move_paddle(placed_.paddle_height, tilt + turn);
    report = then(report, squeeze(state));
    slope = std::min((tilt_error(state) - error) / turn, least_slope);
  }
  if (report.usable()) report.reason = "the paddle's tilt finds no balance with its spring";
  report.converged = false;
  return report;
}

ContactFigures Compression::figures(const State& state, PlateNumber plate) const {
  return contact_figures(*breast_.model, state, *breast_.contact, plate, breast_.contact_faces,
                         breast_.friction.get());
}

double Compression::penetration(const State& state) const {
  return std::max(figures(state, kSupport).penetration,
                  figures(state, kPaddle).penetration);
}

double Compression::paddle_force(const State& state) const {
  return -problem_.plates.up.dot(figures(state, kPaddle).force) * kNewtonPerMilli;
}

void Compression::track_friction(const State& state) {
  if (breast_.friction) breast_.friction->track(*breast_.model, state, breast_.contact_faces);
}

/// Fixes where points stick, for the next step and for those that fail.
void Compression::end_step(const State& state) {
  tilt_ = placed_.paddle_tilt;
  if (!breast_.friction) return;
  breast_.friction->commit(*breast_.model, state, breast_.contact_faces);
  sticking_ = breast_.friction->history();
}

NewtonReport Compression::equilibrate(double fraction, State& state) {
  place(fraction);
  NewtonReport tried;
  if (before_.fraction < reached_.fraction) {
    const double ahead = (fraction - reached_.fraction) / (reached_.fraction - before_.fraction);
    State trial = extrapolated(state, before_.state, ahead);
    if (breast_.friction) breast_.friction->restore(sticking_);
    tried = balance_tilt(squeeze(trial), trial);
    if (tried.usable()) {
      state = std::move(trial);
      return tried;
    }
  }
  place(fraction);
  if (breast_.friction) breast_.friction->restore(sticking_);
  return then(tried, balance_tilt(squeeze(state), state));
}

NewtonReport Compression::squeeze(State& state) {
  const double unit = breast_.penalty_unit();
  PenaltyOptions penalties = penalties_;
  if (penalty_ > 0) {
    penalties.first = penalty_ / unit / penalties.growth;
    penalties.last = penalty_ / unit;
  }
  const NewtonReport report =
      solve_contact(newton_, *breast_.contact, unit, penalties, state);
  if (!report.usable()) return report;
  return then(report, close_gap(
                          newton_, *breast_.contact, kNearlyClosed,
                          [&](const State& s) { return penetration(s); }, penalties_.newton, state));
}

/// At the end of the way: stiffens the penalty until the gap is closed and, in the same solves, moves
/// the paddle until the thickness is the one asked. A state that cannot be bettered stays as it is;
/// summarise() says how good that is.
void Compression::finish(State& state) {
  constexpr int most_rounds = 16;
  constexpr double least_growth = 1.5, most_growth = 5, headroom = 1.2;
  constexpr double far = 1;  // [mm]: stiff contact does not follow a paddle that moves by more
  // Skin between contact points snaps from one place to another, and the extent with it.
  constexpr int patience = 4;
  constexpr double nearly = 0.09;  // [mm]
  double most = most_growth;
  bool soft = false;
  ThicknessSecant secant;
  Found best;
  for (int round = 0, closed = 0; round < most_rounds; ++round) {
    const double excess = penetration(state) / options_.gap_tolerance;
    const double error = frame_.extent(state.x) - problem_.plates.thickness;
    const double lean = tilt_error(state);
    const bool off = std::abs(error) > options_.thickness_tolerance;
    const bool leans = std::abs(lean) > kTiltTolerance;
    if (excess <= 1 && !off && !leans) return;
    if (excess <= 1 && !leans) {
      if (std::abs(error) < best.error)
        best = {std::abs(error), state, placed_, breast_.contact->penalty};
      if (++closed >= patience && best.error <= nearly) break;
    }
    const double growth = excess <= 1 ? 1 : std::clamp(headroom * excess, least_growth, most);
    const double most_move = round == 0 || soft ? std::abs(error) : far;
    const double move = off ? secant.move(error, most_move) : 0;
    const bool good = better(state, [&](State& trial) {
      if (off || leans)
        move_paddle(placed_.paddle_height + move,
                    placed_.paddle_tilt - (leans ? lean / kTiltSlope : 0));
      if (soft || std::abs(move) > far) return squeeze(trial);
      breast_.contact->penalty *= growth;
      return resettle(newton_, *breast_.contact, exact_, trial);
    });
    if (!good && soft) break;
    soft = !good && (growth == 1 || most <= least_growth);
    if (!good) most = std::max(least_growth, std::sqrt(most));
    if (!good) secant = {};
  }
  if (std::isinf(best.error)) return;
  state = best.state;
  put(best.plates);
  breast_.contact->penalty = best.penalty;
  track_friction(state);
}

/// Keeps what `attempt` does to the state, plates and penalty only if it succeeds.
bool Compression::better(State& state, const std::function<NewtonReport(State&)>& attempt) {
  State trial = state;
  const PlacedPlates placed = placed_;
  const double penalty = breast_.contact->penalty;
  const NewtonReport report = attempt(trial);
  report_.newton_iterations += report.iterations;
  report_.indefinite_matrices += report.indefinite;
  if (report.usable()) {
    state = std::move(trial);
    track_friction(state);  // a round that failed inside the attempt may have left another's
    return true;
  }
  put(placed);
  breast_.contact->penalty = penalty;
  track_friction(state);
  return false;
}

void Compression::record(double fraction, const State& state, const NewtonReport& newton) {
  end_step(state);
  before_ = std::exchange(reached_, {fraction, state});
  penalty_ = breast_.contact->penalty;
  const Balance balance = newton_.balance(state);
  report_.history.push_back({frame_.extent(state.x), paddle_force(state), newton.iterations,
                             breast_.contact->penalty, balance.min_J, balance.max_J});
  if (progress_)
    progress_(0.95 * fraction, "compressed to " + in_mm(report_.history.back().thickness_mm));
}

/// Central difference of the total potential over the paddle's height, friction's part with it
/// (contact pressures as they are: its potential knows no other).
double Compression::energy_force(const State& state) {
  breast_.contact->follow = {};
  constexpr double nudge = 1e-3;  // [mm]: small beside penetrations, so that contact stays
  const double height = placed_.paddle_height, tilt = placed_.paddle_tilt;
  double energy[2];
  for (int side = 0; side < 2; ++side) {
    State nudged = state;
    move_paddle(height + (side ? nudge : -nudge), tilt);
    const NewtonReport report = resettle(newton_, *breast_.contact, exact_, nudged);
    energy[side] = report.usable() ? newton_.balance(nudged).energy
                                   : std::numeric_limits<double>::quiet_NaN();
  }
  move_paddle(height, tilt);
  return (energy[0] - energy[1]) / (2 * nudge) * kNewtonPerMilli;
}

double Compression::wall_gap(const State& state) const {
  if (!breast_.wall) return 0;
  double largest = 0;
  for (const auto& [e, number] : breast_.wall_faces) {
    const auto x = breast_.model->coefficients(state.x, e);
    for (const Face& face : breast_.model->faces(e))
      for (int q = 0; face.face() == number && q < face.num_points(); ++q)
        largest = std::max(largest, std::abs(breast_.wall->gap(face.deformed(x, q).head<3>()).gap));
  }
  return largest;
}

/// Of the tissue in front of the plates' edges [mm³], in reference volume.
double Compression::volume_in_front(const State& state) const {
  const HermiteMesh shape(state.x, problem_.mesh.mesh.elements());
  const auto& t = hermite_table().points;
  double volume = 0;
  for (int e = 0; e < breast_.model->num_elements(); ++e)
    for (int q = 0; q < kPoints; ++q)
      if (problem_.plates.depth.dot(shape.position({e, {t[q & 3], t[q >> 2 & 3], t[q >> 4]}})) > placed_.edge)
        volume += breast_.model->element(e).point_weight(q);
  return volume;
}

void Compression::summarise(const State& state) {
  const Balance balance = newton_.balance(state);
  const ContactFigures paddle = figures(state, kPaddle);
  report_.thickness_mm = frame_.extent(state.x);
  report_.force_N = paddle_force(state);
  report_.paddle_tilt_deg = placed_.paddle_tilt;
  report_.contact_area_cm2 = paddle.area * kCm2PerMm2;
  report_.volume_change = balance.deformed_volume / breast_.model->volume() - 1;
  report_.min_J = balance.min_J;
  report_.max_J = balance.max_J;
  report_.max_penetration_mm = penetration(state);
  report_.wall_gap_mm = wall_gap(state);
  report_.retained_fraction = volume_in_front(state) / volume_in_front(breast_.model->rest());
  int within = 0;
  for (int e = 0; e < breast_.model->num_elements(); ++e)
    for (const auto& F :
         breast_.model->element(e).deformation_gradients(breast_.model->coefficients(state.x, e)))
      within += F.determinant() >= 0.5 && F.determinant() <= 1.5;
  report_.J_within_half = within / double(kPoints * breast_.model->num_elements());
}

void Compression::judge(const LoadSteppingReport& load) {
  constexpr double most_error = 0.1, most_penetration = 0.1;  // [mm]: what "reached" means
  constexpr double most_slack = 5;  // [mm] between skin and flat plates
  constexpr double least_retained = 0.5;
  const double error = std::abs(report_.thickness_mm - problem_.plates.thickness);
  const double apart = placed_.paddle_height - placed_.support_height;
  const bool loose = apart > report_.thickness_mm + most_slack;
  if (!load.complete())
    report_.reason = load.reason;
  else if (loose && report_.retained_fraction < least_retained)
    report_.reason = "the breast slipped out backwards: the plates stand " + in_mm(apart) +
                     " apart (stiffer chest-wall springs or friction would hold it)";
  else if (error > most_error)
    report_.reason = "the thickness stays " + in_mm(error) + " off";
  else if (report_.max_penetration_mm > most_penetration)
    report_.reason = "a point stays " + in_mm(report_.max_penetration_mm) + " inside a plate";
  else
    report_.status = CompressionStatus::converged;
  if (!report_.usable())
    report_.reason = "stopped at " + in_mm(report_.thickness_mm) + " of " +
                     in_mm(problem_.plates.thickness) + ": " + report_.reason;
}

/// Brings the breast to rest under gravity, the plates away; false where it does not come to rest.
bool Compression::settle(State& state) {
  placed_ = start_;
  breast_.contact->plates.clear();
  if (problem_.gravity.isZero()) return true;
  const LoadSteppingReport load =
      raise_body_force(breast_, newton_, problem_.density * problem_.gravity, {}, state);
  report_.newton_iterations += load.iterations;
  report_.indefinite_matrices += load.indefinite;
  if (!load.complete()) report_.reason = "does not come to rest under gravity: " + load.reason;
  return load.complete();
}

CompressionResult Compression::run() {
  const auto begin = std::chrono::steady_clock::now();
  State state = breast_.model->rest();
  if (!settle(state)) return {state.x, state.pressure, placed_, report_};
  place(0);
  end_step(state);
  reached_ = {0, state};
  const double longest = std::min(1.0, options_.longest_move / longest_way());
  const LoadSteppingReport load = step_load(
      state,
      {std::min(longest, options_.first_step), longest * options_.smallest_step,
       options_.max_iterations, kStepGrowth, longest},
      [&](double fraction, State& s) { return equilibrate(fraction, s); },
      [&](double fraction, const State& s, const NewtonReport& n) { record(fraction, s, n); });
  report_.steps = load.steps;
  report_.cutbacks = load.cutbacks;
  report_.newton_iterations += load.iterations;
  report_.indefinite_matrices += load.indefinite;
  if (load.complete())
    finish(state);
  else
    place(load.reached);
  summarise(state);
  judge(load);
  if (report_.usable()) report_.energy_force_N = energy_force(state);
  report_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (progress_) progress_(1, "compressed to " + in_mm(report_.thickness_mm));
  return {state.x, state.pressure, placed_, report_};
}

}  // namespace

TissueLaws TissueLaws::defaults() {
  return {{std::make_shared<NeoHookean>(0.75), std::make_shared<NeoHookean>(2.5),
           std::make_shared<NeoHookean>(3.3)},
          Mixing::geometric};
}

CompressionResult compress(const CompressionProblem& problem, const CompressionOptions& options,
                           const Progress& progress) {
  check_shape(problem.mesh.mesh);
  return Compression(problem, options, progress).run();
}

}  // namespace mammotwin
