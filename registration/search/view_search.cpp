#include "registration/search/view_search.h"

#include <utility>

#include "registration/search/placed_baseline.h"
#include "registration/search/solved_search.h"

namespace mammotwin {
namespace {

/// A view's frame once the breast is turned and shifted on the detector.
CompressedView laid_on_detector(CompressedView view, const ViewState& state) {
  view.turn_deg = state[kTurn];
  view.frame.axes = axes_of(view.side, view.angle_deg, view.turn_deg);
  view.frame.origin_in_lps -=
      view.frame.axes.transpose() * Eigen::Vector3d(state[kShiftDepth], state[kShiftLateral], 0);
  return view;
}

Nodes in_lps(Nodes nodes, const ViewFrame& frame) {
  for (HermiteMesh::Node& node : nodes) {
    node = (frame.axes.transpose() * node).eval();
    node.col(0) += frame.origin_in_lps;
  }
  return nodes;
}

ReducedView unsolved(const SearchInput& input) {
  ReducedView view;
  view.base = in_view(input.file.mesh.nodes(), input.view.frame);
  view.failed_solves = 2 * kMechanical;
  return view;
}

/// By secants where a search will go far, else by slopes.
ReducedView reduced_view(const SearchInput& input) {
  ReducedView view = !input.solver    ? unsolved(input)
                     : input.evidence ? reduce_view(*input.solver, prior_sd())
                                      : linear_view(*input.solver, unseen_sd());
  view.elements = input.file.mesh.elements();
  return view;
}

ViewUncertainty uncertainty(const ReducedView& reduced, const ViewState& z,
                            const ViewFrame& frame) {
  ViewUncertainty result;
  result.sd = reduced.sd;
  for (int i = 0; i < kMechanical; ++i)
    if (!reduced.modes[i].linear.empty())
      result.varied[i] = in_lps(reduced.nodes_along_slope(z, i), frame);
  return result;
}

AffineBaseline baseline_of(const SearchInput& input, double thickness_mm,
                           const Eigen::Vector3d& nipple_in_lps) {
  return placed_baseline(input.file, input.view, thickness_mm, nipple_in_lps, input.detector,
                         input.evidence);
}

/// As it was computed, with no mammogram to bring it to.
SearchedView unmatched(const SearchInput& input, const ReducedView& reduced,
                       const Eigen::Vector3d& nipple_in_lps) {
  SearchedView result{input.view, input.file.mesh,
                      baseline_of(input, input.view.thickness_mm, nipple_in_lps)};
  result.uncertainty = uncertainty(reduced, ViewState::Zero(), input.view.frame);
  result.failed_solves = reduced.failed_solves;
  return result;
}

/// As it lies on its mammogram, view `number` of those that were searched.
SearchedView matched(const SearchInput& input, const ViewToSearch& found, const SolvedSearch& end,
                     std::size_t number, const Eigen::Vector3d& nipple_in_lps) {
  const ReducedView& reduced = found.match.view();
  const ViewState& z = end.states[number];
  const ViewState state = z.cwiseProduct(reduced.sd);
  const CompressedView& view = found.solved.view;
  SearchedView result{laid_on_detector(view, state),
                      HermiteMesh(in_lps(reduced.nodes_at(z), view.frame), reduced.elements),
                      baseline_of(input, view.thickness_mm, nipple_in_lps)};
  result.uncertainty = uncertainty(reduced, z, view.frame);
  result.uncertainty.covariance = end.pose.covariances[number];
  result.state = state;
  result.state_sd = result.uncertainty.covariance.diagonal().cwiseSqrt().cwiseProduct(reduced.sd);
  result.after = found.match.figures(z);
  result.evidence_variance = end.pose.evidence_variance;
  result.complete = end.complete;
  result.failed_solves = reduced.failed_solves;
  return result;
}

}  // namespace

std::vector<SearchedView> search_views(const std::vector<SearchInput>& inputs,
                                       const Volume<Fractions>& fractions,
                                       const Eigen::Vector3d& nipple_in_lps,
                                       const Progress& progress) {
  std::vector<SearchedView> result;
  std::vector<ViewToSearch> searched;
  std::vector<std::size_t> places;  // of the searched among all
  std::vector<MatchFigures> before;
  for (std::size_t v = 0; v < inputs.size(); ++v) {
    const SearchInput& input = inputs[v];
    if (progress) progress(0.3 * v, "sensitivities of " + input.view.name);
    const ReducedView reduced = reduced_view(input);
    result.push_back(unmatched(input, reduced, nipple_in_lps));
    if (!input.evidence || !input.solver) continue;
    searched.push_back({ViewMatch(reduced, input.file.faces, prone_of(input.file), &fractions,
                                  nipple_in_lps, input.detector, *input.evidence),
                        &*input.solver,
                        {{}, input.view}});
    places.push_back(v);
    before.push_back(searched.back().match.figures(ViewState::Zero()));
  }
  const SolvedSearch end = search_and_solve(searched, progress);
  for (std::size_t m = 0; m < searched.size(); ++m) {
    SearchedView& view = result[places[m]];
    view = matched(inputs[places[m]], searched[m], end, m, nipple_in_lps);
    view.before = before[m];
  }
  return result;
}

}  // namespace mammotwin
