#include "registration/search/nearby_solver.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "registration/view/view_of_plates.h"
#include "solver/press/compress.h"
#include "solver/press/nearby_equilibria.h"

namespace mammotwin {
namespace {

// Of a standard deviation, to either side: a derivative. Plates must move by less than what contact
// lets them sink in (hundredths of a mm), for beyond that the residual is not linear.
constexpr double kStateNudge = 1e-4;
// Of the penalty that the compression ended with: the softest at which the breast stays where it
// is.
constexpr std::array<double, 2> kSofter = {0.3, 1};
// Of the friction that holds neighbours [mm]. Against pressing anew at a standard deviation of each
// number, Coulomb's friction from the solved state finds no equilibrium in a third of the cases;
// springs of 0.5 to 2 mm come as near, of 5 mm and more let a breast go.
constexpr double kFrictionReach = 2;

CompressionOptions soft_options() {
  CompressionOptions options;
  options.gap_tolerance = 0.5;
  options.thickness_tolerance = 1e3;  // the plates stay where they are put
  options.frozen_friction = kFrictionReach;
  return options;
}

Eigen::Vector3d mean_of(const Nodes& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const HermiteMesh::Node& node : nodes) sum += node.col(0);
  return sum / static_cast<double>(nodes.size());
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

Nodes in_lps(Nodes nodes, const ViewFrame& frame) {
  for (HermiteMesh::Node& node : nodes) {
    node = (frame.axes.transpose() * node).eval();
    node.col(0) += frame.origin_in_lps;
  }
  return nodes;
}

NearbySolver::NearbySolver(SolvedView base, ProblemAt problem_at)
    : base_(std::move(base)), problem_at_(std::move(problem_at)) {
  CompressionResult near = base_.result;
  // At a softer penalty they would press points that left their plate long since: a breast near
  // the brink of slipping backwards slid out altogether.
  const double penalty = near.penalty;
  for (const double softer : kSofter) {
    near.penalty = softer * penalty;
    soft_base_ = solve_from(near, ViewState::Zero());
    if (soft_base_) break;
  }
}

CompressedView NearbySolver::view_at(const ViewState& state, const PlateOptions& plates,
                                     const CompressionResult& result) const {
  CompressedView view =
      view_of_plates(base_.view.name, base_.view.side, base_.view.angle_deg + state[kRoll],
                     base_.view.turn_deg, plates, result);
  const Eigen::Vector3d middle = mean_of(base_.result.deformed);
  const auto along_edge = [&](const ViewFrame& frame) {
    return frame.axes.row(1).dot(middle - frame.origin_in_lps);
  };
  const double off = along_edge(view.frame) - along_edge(base_.view.frame);
  view.frame.origin_in_lps += off * view.frame.axes.row(1).transpose();
  return view;
}

std::optional<SolvedView> NearbySolver::solve_from(const CompressionResult& near,
                                                   const ViewState& state) const {
  try {
    const CompressionProblem problem = problem_at_(state);
    CompressionResult result = compress_from(near, problem, soft_options());
    // A breast that slid out altogether leaves plates without a place.
    if (!result.report.usable() || !std::isfinite(result.plates.paddle_height)) return std::nullopt;
    const CompressedView view = view_at(state, problem.plates, result);
    return SolvedView{std::move(result), view};
  } catch (const std::invalid_argument&) {  // a state in which the problem cannot be posed
    return std::nullopt;
  }
}

Walk NearbySolver::walk_from(const SolvedView& solved, const ViewState& at, const ViewState& to,
                             double shortest) const {
  return walk(solved, shortest, [&](const SolvedView& near, double share) {
    return solve_from(near.result, at + share * (to - at));
  });
}

Walk NearbySolver::walk_to(const ViewState& state, double shortest) const {
  return walk_from(soft_base_.value(), ViewState::Zero(), state, shortest);
}

std::optional<SolvedView> NearbySolver::solve(const ViewState& state) const {
  if (!soft_base_) return std::nullopt;
  Walk walk = walk_to(state);
  if (walk.share < 1) return std::nullopt;
  return std::move(walk.end);
}

std::optional<Slopes> NearbySolver::slopes(const ViewState& sd) const {
  if (!soft_base_) return std::nullopt;
  const NearbyEquilibria nearby(soft_base_->result, problem_at_(ViewState::Zero()), soft_options());
  if (!nearby.usable()) return std::nullopt;
  Slopes slopes;
  for (int i = 0; i < kMechanical; ++i) {
    if (sd[i] == 0) continue;
    const ViewState nudge = kStateNudge * sd[i] * ViewState::Unit(i);
    try {
      slopes[i] = change_between(nearby, -nudge, nudge);
      for (HermiteMesh::Node& node : slopes[i]) node /= 2 * kStateNudge;
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
    return in_view(combined(1, soft_base_->result.deformed, share, step.nodes),
                   view_at(state, options, result).frame);
  };
  return combined(1, placed(0.5, to, upper.plates, step.to), -1,
                  placed(-0.5, from, lower.plates, step.from));
}

}  // namespace mammotwin
