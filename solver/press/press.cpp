#include "solver/press/press.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solver/units.h"

namespace mammotwin {

namespace {

constexpr double kStepTolerance = 5e-2, kCarefulTolerance = 1e-2;  // of load steps
constexpr int kCarefulFalls = 20;
constexpr double kSoft = 10;  // for a breast at rest: tissue comes in by some 2 mm

}  // namespace

Press::Press(const CompressionProblem& problem, const CompressionOptions& options)
    : problem_(problem),
      options_(options),
      positioned_(as_positioned(problem)),
      breast_(make_pressed_breast(problem, options.solid)),
      frame_(positioned_, problem.plates),
      newton_(*breast_.model, *breast_.dofs) {
  if (breast_.friction)
    breast_.contact->follow = following(*breast_.friction, *breast_.model, breast_.contact_faces);
}

void Press::put(const PlacedPlates& placed) {
  placed_ = placed;
  breast_.contact->plates = {placed_.support, placed_.paddle};
}

void Press::move_paddle(double height, double tilt) {
  put(frame_.place(placed_.support_height, height, tilt));
}

ContactFigures Press::figures(const State& state, PlateNumber plate) const {
  return contact_figures(*breast_.model, state, *breast_.contact, plate, breast_.contact_faces,
                         breast_.friction.get());
}

double Press::penetration(const State& state) const {
  return std::max(figures(state, kSupport).penetration, figures(state, kPaddle).penetration);
}

double Press::mean_gap(const State& state) const {
  return std::max(figures(state, kSupport).mean_gap, figures(state, kPaddle).mean_gap);
}

double Press::paddle_force(const State& state) const {
  return -problem_.plates.up.dot(figures(state, kPaddle).force) * kNewtonPerMilli;
}

double Press::tilt_error(const State& state) const {
  const PlateOptions& plates = problem_.plates;
  if (std::isinf(plates.tilt_spring)) return 0;
  const ContactFigures paddle = figures(state, kPaddle);
  const Eigen::Vector3d pivot =
      placed_.paddle.point + (plates.pivot - plates.rounding) * placed_.paddle.depth;
  const double moment =
      plates.depth.cross(plates.up).dot(paddle.moment - pivot.cross(paddle.force));
  return plates.paddle_tilt + moment / plates.tilt_spring - placed_.paddle_tilt;
}

NewtonReport Press::squeeze(State& state, double penalty, bool near) {
  const double unit = breast_.penalty_unit();
  PenaltyOptions penalties;
  penalties.first = kSoft;
  penalties.newton = newton_to(options_.careful ? kCarefulTolerance : kStepTolerance);
  if (penalty > 0) {
    penalties.last = penalty / unit;
    penalties.first = near ? penalties.last : penalties.last / penalties.growth;
  }
  const NewtonReport report = solve_contact(newton_, *breast_.contact, unit, penalties, state);
  if (!report.usable()) return report;
  return then(report, close_gap(
                          newton_, *breast_.contact, kDeepest,
                          [&](const State& s) { return penetration(s); }, penalties.newton, state));
}

NewtonOptions Press::newton_to(double tolerance) const {
  NewtonOptions newton = loosened({}, tolerance);
  if (!options_.careful) return newton;
  newton.stable_below = kCarefulTolerance;
  newton.most_falls = kCarefulFalls;
  return newton;
}

NewtonReport Press::resettle(State& state, double tolerance) {
  return mammotwin::resettle(newton_, *breast_.contact, newton_to(tolerance), state);
}

void Press::track_friction(const State& state) {
  if (breast_.friction) breast_.friction->track(*breast_.model, state, breast_.contact_faces);
}

PlateFriction::History Press::commit_friction(const State& state) {
  if (!breast_.friction) return {};
  breast_.friction->commit(*breast_.model, state, breast_.contact_faces);
  return breast_.friction->history();
}

void Press::restore_friction(const PlateFriction::History& history) {
  if (breast_.friction) breast_.friction->restore(history);
}

std::vector<PlateFriction::Hold> Press::holds(const State& state) const {
  if (!breast_.friction) return {};
  return breast_.friction->holds(*breast_.model, state, breast_.contact_faces);
}

void Press::hold_by_friction(const std::vector<PlateFriction::Hold>& holds, const State& state) {
  mammotwin::hold_by_friction(breast_, holds, state, options_.frozen_friction);
  if (options_.frozen_friction > 0) breast_.contact->follow = {};
}

}  // namespace mammotwin
