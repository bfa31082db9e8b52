#include "registration/reduced_view.h"

#include "solver/press/nearby_equilibria.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mammotwin {
namespace {

// Of a standard deviation, to either side: a derivative. Plates must move by less than what contact
// lets them sink in (hundredths of a mm), for beyond that the residual is not linear.
constexpr double kNudge = 1e-4;
// Of the penalty that the compression ended with: the softest at which the breast stays where it is.
constexpr std::array<double, 3> kSofter = {0.1, 0.3, 1};

CompressionOptions soft_options() {
  CompressionOptions options;
  options.gap_tolerance = 0.5;
  options.thickness_tolerance = 1e3;  // the plates stay where they are put
  return options;
}

Nodes combined(double a, const Nodes& x, double b, const Nodes& y) {
  Nodes sum = x;
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] = a * x[i] + b * y[i];
  return sum;
}

void add(double factor, const Nodes& mode, Nodes& sum) {
  for (std::size_t i = 0; i < mode.size(); ++i) sum[i] += factor * mode[i];
}

ReducedView::Mode mode_of(const Nodes& base, const std::optional<Nodes>& up,
                          const std::optional<Nodes>& down) {
  const Nodes none(base.size(), HermiteMesh::Node::Zero());
  if (!up && !down) return {};
  if (!down) return {combined(1, *up, -1, base), none};
  if (!up) return {combined(1, base, -1, *down), none};
  Nodes bend = combined(0.5, *up, 0.5, *down);
  add(-1, base, bend);
  return {combined(0.5, *up, -0.5, *down), bend};
}

/// The base, with no number known to have an effect.
ReducedView unvaried_view(const NearbySolver& solver, const ViewState& sd) {
  ReducedView reduced;
  reduced.sd = sd;
  reduced.base = in_view(solver.base().result.deformed, solver.base().view.frame);
  reduced.failed_solves = 2 * kMechanical;
  return reduced;
}

}  // namespace

Nodes in_view(const Nodes& nodes, const ViewFrame& frame) {
  Nodes result = nodes;
  for (HermiteMesh::Node& node : result) {
    node.col(0) -= frame.origin_in_lps;
    node = (frame.axes * node).eval();
  }
  return result;
}

CompressedView view_of_plates(const std::string& name, Side side, double angle_deg,
                              const PlateOptions& options, const CompressionResult& result) {
  CompressedView view{name, side, angle_deg, result.report.thickness_mm, {}};
  view.frame.axes = view_axes(side, angle_deg);
  const Eigen::Vector3d depth = options.depth, up = options.up;
  const Eigen::Vector3d across(depth.y() * up.z() - depth.z() * up.y(),
                               depth.z() * up.x() - depth.x() * up.z(),
                               depth.x() * up.y() - depth.y() * up.x());
  view.frame.origin_in_lps = depth * result.plates.edge + up * result.plates.support_height +
                             across * result.plates.lateral_middle;
  return view;
}

NearbySolver::NearbySolver(SolvedView base, ProblemAt problem_at)
    : base_(std::move(base)), problem_at_(std::move(problem_at)) {
  CompressionResult near = base_.result;
  const double penalty = near.penalty;
  for (const double softer : kSofter) {
    near.penalty = softer * penalty;
    soft_base_ = solve_from(near, ViewState::Zero());
    if (soft_base_) break;
  }
}

std::optional<SolvedView> NearbySolver::solve_from(const CompressionResult& near,
                                                   const ViewState& state) const {
  try {
    const CompressionProblem problem = problem_at_(state);
    CompressionResult result = compress_from(near, problem, soft_options());
    if (!result.report.usable()) return std::nullopt;
    const CompressedView view =
        view_of_plates(base_.view.name, base_.view.side, base_.view.angle_deg + state[kRoll],
                       problem.plates, result);
    return SolvedView{std::move(result), view};
  } catch (const std::invalid_argument&) {  // a state in which the problem cannot be posed
    return std::nullopt;
  }
}

std::optional<SolvedView> NearbySolver::solve(const ViewState& state) const {
  if (!soft_base_) return std::nullopt;
  if (auto direct = solve_from(soft_base_->result, state)) return direct;
  const auto half = solve_from(soft_base_->result, state / 2);
  return half ? solve_from(half->result, state) : std::nullopt;
}

std::optional<Slopes> NearbySolver::slopes(const ViewState& sd) const {
  if (!soft_base_) return std::nullopt;
  const NearbyEquilibria nearby(soft_base_->result, problem_at_(ViewState::Zero()), soft_options());
  if (!nearby.usable()) return std::nullopt;
  Slopes slopes;
  for (int i = 0; i < kMechanical; ++i) {
    const ViewState nudge = kNudge * sd[i] * ViewState::Unit(i);
    try {
      slopes[i] = change_between(nearby, -nudge, nudge);
      for (HermiteMesh::Node& node : slopes[i]) node /= 2 * kNudge;
    } catch (const std::invalid_argument&) {  // a state in which the problem cannot be posed
    }
  }
  return slopes;
}

/// Nodes as they stand in the view at `to`, less those at `from`.
Nodes NearbySolver::change_between(const NearbyEquilibria& nearby, const ViewState& from,
                                   const ViewState& to) const {
  const CompressionProblem lower = problem_at_(from), upper = problem_at_(to);
  const NearbyEquilibria::Step step = nearby.step(lower, upper);
  const auto placed = [&](double share, const ViewState& state, const PlateOptions& options,
                          const PlacedPlates& plates) {
    CompressionResult result;
    result.plates = plates;
    const CompressedView view = view_of_plates(base_.view.name, base_.view.side,
                                               base_.view.angle_deg + state[kRoll], options, result);
    return in_view(combined(1, soft_base_->result.deformed, share, step.nodes), view.frame);
  };
  return combined(1, placed(0.5, to, upper.plates, step.to), -1,
                  placed(-0.5, from, lower.plates, step.from));
}

Nodes ReducedView::nodes_at(const ViewState& z) const {
  Nodes x = base;
  for (int i = 0; i < kMechanical; ++i) {
    add(z[i], modes[i].linear, x);
    add(z[i] * z[i], modes[i].quadratic, x);
  }
  return x;
}

Nodes ReducedView::nodes_along_slope(const ViewState& z, int number) const {
  Nodes x = nodes_at(z);
  add(1, modes[number].linear, x);
  add(2 * z[number], modes[number].quadratic, x);
  return x;
}

Eigen::Vector3d ReducedView::placed(const Eigen::Vector3d& x, const ViewState& z) const {
  const double t = z[kTurn] * sd[kTurn] * std::numbers::pi / 180;
  return {std::cos(t) * x.x() - std::sin(t) * x.y() + z[kShiftDepth] * sd[kShiftDepth],
          std::sin(t) * x.x() + std::cos(t) * x.y() + z[kShiftLateral] * sd[kShiftLateral], x.z()};
}

void ReducedView::rebase(const ViewState& z, const Nodes& solved_in_view) {
  add(1, combined(1, solved_in_view, -1, nodes_at(z)), base);
}

ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd) {
  ReducedView reduced = unvaried_view(solver, sd);
  const auto soft = solver.solve(ViewState::Zero());
  if (!soft) return reduced;
  const Nodes zero = in_view(soft->result.deformed, soft->view.frame);
  std::array<std::optional<Nodes>, 2 * kMechanical> found;
  tbb::parallel_for(0, 2 * kMechanical, [&](int task) {
    ViewState state = ViewState::Zero();
    state[task / 2] = task % 2 ? -sd[task / 2] : sd[task / 2];
    // Isolated: else a thread that waits inside one solve would begin another on top of it.
    tbb::this_task_arena::isolate([&] {
      if (const auto solved = solver.solve(state))
        found[task] = in_view(solved->result.deformed, solved->view.frame);
    });
  });
  reduced.failed_solves = 0;
  for (int i = 0; i < kMechanical; ++i) {
    reduced.modes[i] = mode_of(zero, found[2 * i], found[2 * i + 1]);
    reduced.failed_solves += !found[2 * i] + !found[2 * i + 1];
  }
  return reduced;
}

ReducedView linear_view(const NearbySolver& solver, const ViewState& sd) {
  ReducedView reduced = unvaried_view(solver, sd);
  const auto slopes = solver.slopes(sd);
  if (!slopes) return reduced;
  reduced.failed_solves = 0;
  for (int i = 0; i < kMechanical; ++i) {
    const Nodes& slope = (*slopes)[i];
    if (slope.empty())
      reduced.failed_solves += 2;
    else
      reduced.modes[i] = {slope, Nodes(slope.size(), HermiteMesh::Node::Zero())};
  }
  return reduced;
}

}  // namespace mammotwin
