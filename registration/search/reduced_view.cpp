#include "registration/search/reduced_view.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace mammotwin {
namespace {

void add(double factor, const Nodes& mode, Nodes& sum) {
  for (std::size_t i = 0; i < mode.size(); ++i) sum[i] += factor * mode[i];
}

/// Nodes in the view at a share of a standard deviation, which is negative below; 0: none was
/// found.
struct Sample {
  double share = 0;
  Nodes nodes;
};

/// The quadratic through the base and what was found on both sides, or the line through one of
/// them.
ReducedView::Mode mode_of(const Nodes& base, const Sample& up, const Sample& down) {
  const auto slope_to = [&](const Sample& sample) {
    return combined(1 / sample.share, sample.nodes, -1 / sample.share, base);
  };
  const Nodes none(base.size(), HermiteMesh::Node::Zero());
  if (up.share == 0 && down.share == 0) return {};
  if (down.share == 0) return {slope_to(up), none};
  if (up.share == 0) return {slope_to(down), none};
  const Nodes above = slope_to(up), below = slope_to(down);
  const double apart = up.share - down.share;
  return {combined(-down.share / apart, above, up.share / apart, below),
          combined(1 / apart, above, -1 / apart, below)};
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

Nodes ReducedView::undeformed_at(const ViewState& z) const {
  Nodes x = base;
  for (int i = 0; i < kMechanical; ++i) {
    add(z[i], modes[i].linear, x);
    add(z[i] * z[i], modes[i].quadratic, x);
  }
  return x;
}

Nodes ReducedView::nodes_at(const ViewState& z) const { return deformed(undeformed_at(z)); }

Nodes ReducedView::nodes_along_slope(const ViewState& z, int number) const {
  Nodes x = undeformed_at(z);
  add(1, modes[number].linear, x);
  add(2 * z[number], modes[number].quadratic, x);
  return deformed(std::move(x));
}

Nodes ReducedView::deformed(Nodes nodes) const {
  for (HermiteMesh::Node& node : nodes) node = deformation.moved(node);
  return nodes;
}

Eigen::Vector3d ReducedView::placed(const Eigen::Vector3d& x_in_view, const ViewState& z) const {
  Eigen::Vector3d x = x_in_view;
  x.head<2>() += deformation.at(x.head<2>());
  const double t = z[kTurn] * sd[kTurn] * std::numbers::pi / 180;
  return {std::cos(t) * x.x() - std::sin(t) * x.y() + z[kShiftDepth] * sd[kShiftDepth],
          std::sin(t) * x.x() + std::cos(t) * x.y() + z[kShiftLateral] * sd[kShiftLateral], x.z()};
}

PlatesEdge ReducedView::plates_edge(const ViewState& z) const {
  const ViewState state = z.cwiseProduct(sd);
  return {state[kTurn], {state[kShiftDepth], state[kShiftLateral]}};
}

void ReducedView::expect(const EdgePrior& expected) {
  edge = expected;
  for (const int i : {kTurn, kShiftDepth, kShiftLateral}) sd[i] = edge.sd[i];
}

void ReducedView::rebase(const ViewState& z, const Nodes& solved_in_view) {
  deformation = {};
  add(1, combined(1, solved_in_view, -1, nodes_at(z)), base);
}

ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd) {
  std::vector<int> all;
  for (int i = 0; i < kMechanical; ++i)
    if (sd[i] > 0) all.push_back(i);
  return reduce_view(solver, sd, all);
}

ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd,
                        const std::vector<int>& numbers) {
  ReducedView reduced = unvaried_view(solver, sd);
  if (!solver.soft_base()) return reduced;
  const auto sample_at = [&](const ViewState& state, double sign) {
    const Walk walk = solver.walk_to(state);
    if (walk.share == 0) return Sample{};
    return Sample{sign * walk.share, in_view(walk.end.result.deformed, walk.end.view.frame)};
  };
  std::vector<Sample> found(2 * numbers.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t task) {
    const int i = numbers[task / 2];
    const double sign = task % 2 ? -1 : 1;
    // Isolated: else a thread that waits inside one solve would begin another on top of it.
    tbb::this_task_arena::isolate(
        [&] { found[task] = sample_at(sign * sd[i] * ViewState::Unit(i), sign); });
  });
  const Nodes zero = in_view(solver.soft_base()->result.deformed, solver.soft_base()->view.frame);
  reduced.failed_solves = 0;
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const Sample &up = found[2 * n], &down = found[2 * n + 1];
    reduced.modes[numbers[n]] = mode_of(zero, up, down);
    reduced.failed_solves += (up.share == 0) + (down.share == 0);
  }
  if (reduced.failed_solves == static_cast<int>(found.size())) return unvaried_view(solver, sd);
  return reduced;
}

ReducedView linear_view(const NearbySolver& solver, const ViewState& sd) {
  ReducedView reduced = unvaried_view(solver, sd);
  const auto slopes = solver.slopes(sd);
  if (!slopes) return reduced;
  reduced.failed_solves = 0;
  for (int i = 0; i < kMechanical; ++i) {
    const Nodes& slope = (*slopes)[i];
    if (sd[i] == 0) continue;
    if (slope.empty())
      reduced.failed_solves += 2;
    else
      reduced.modes[i] = {slope, Nodes(slope.size(), HermiteMesh::Node::Zero())};
  }
  return reduced;
}

}  // namespace mammotwin
