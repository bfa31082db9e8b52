#include "registration/search/view_search.h"

#include <utility>

#include "registration/carry/point_carrier.h"
#include "registration/search/placed_baseline.h"
#include "registration/search/solved_search.h"
#include "registration/search/view_disagreement.h"
#include "registration/view/laid_on_detector.h"

namespace mammotwin {
namespace {

CompressedView laid_on_detector(const CompressedView& view, const ViewState& state) {
  return laid_on_detector(view, state[kTurn], {state[kShiftDepth], state[kShiftLateral]});
}

ReducedView unsolved(const SearchInput& input) {
  ReducedView view;
  view.base = in_view(input.file.mesh.nodes(), input.view.frame);
  view.failed_solves = 2 * kMechanical;
  return view;
}

/// Numbers that this breast has not, do not vary.
ViewState deviations(const MeshFile& file) {
  ViewState sd = prior_sd();
  if (!file.configurations.contains(kRounderByCoil)) sd[kCoilRoundness] = 0;
  return sd;
}

/// By secants where a search will go far, else by slopes.
ReducedView reduced_view(const SearchInput& input) {
  ReducedView view = !input.solver    ? unsolved(input)
                     : input.evidence ? reduce_view(*input.solver, deviations(input.file))
                                      : linear_view(*input.solver, deviations(input.file));
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

PlacedBaseline baseline_of(const SearchInput& input, const CompressedView& view,
                           const EdgePrior& edge, const Eigen::Vector3d& nipple_in_lps) {
  return placed_baseline(input.file, view, nipple_in_lps, edge, input.detector, input.evidence);
}

EdgePrior edge_of(const SearchInput& input, const Eigen::Vector3d& nipple_in_lps) {
  const PointCarrier carrier(prone_of(input.file), input.file.mesh);
  return edge_prior(input.file, input.view, carrier.carry(nipple_in_lps).in_lps);
}

/// As it was computed, its detector where edges are expected, with no mammogram to bring it to.
SearchedView unmatched(const SearchInput& input, const ReducedView& reduced, const EdgePrior& edge,
                       const Eigen::Vector3d& nipple_in_lps) {
  SearchedView result{laid_on_detector(input.view, edge.mean), input.file.mesh,
                      baseline_of(input, input.view, edge, nipple_in_lps).baseline};
  result.uncertainty = uncertainty(reduced, ViewState::Zero(), input.view.frame);
  result.uncertainty.sd = edge.sd;
  result.uncertainty.covariance = edge.covariance();
  // Without a mammogram only places in the breast's own frame are told: what goes with its turn.
  if (!input.evidence) result.uncertainty.covariance(kShiftLateral, kShiftLateral) -= 1;
  result.uncertainty.discrepancy_mm = uncorrected_sd_mm(input.view.escape, input.view.thickness_mm);
  if (input.solver) result.what_if = what_if_shapes(reduced, ViewState::Zero(), input.view.frame);
  result.failed_solves = reduced.failed_solves;
  return result;
}

CompressedView with_thickness(CompressedView view, double thickness_mm) {
  view.thickness_mm = thickness_mm;
  return view;
}

double disagreement(const ViewMatch& match, const SolvedSearch& end, std::size_t number) {
  const PoseEstimate alone = search_pose({&match}, {end.states[number]});
  return view_disagreement(match, {end.states[number], end.pose.covariances[number]},
                           {alone.states.front(), alone.covariances.front()});
}

/// As it lies on its mammogram, view `number` of those that were searched.
SearchedView matched(const SearchInput& input, const ViewToSearch& found, const SolvedSearch& end,
                     std::size_t number, const EdgePrior& edge,
                     const Eigen::Vector3d& nipple_in_lps) {
  const ReducedView& reduced = found.match.view();
  const ViewState& z = end.states[number];
  const ViewState state = z.cwiseProduct(reduced.sd);
  const CompressedView& view = found.solved.view;
  const PlacedBaseline baseline =
      baseline_of(input, with_thickness(input.view, view.thickness_mm), edge, nipple_in_lps);
  SearchedView result{laid_on_detector(view, state),
                      HermiteMesh(in_lps(reduced.nodes_at(z), view.frame), reduced.elements),
                      baseline.baseline};
  result.baseline_left = baseline.left;
  result.uncertainty = uncertainty(reduced, z, view.frame);
  result.uncertainty.covariance = end.pose.covariances[number];
  result.what_if = what_if_shapes(reduced, z, view.frame);
  result.state = state;
  result.state_sd = result.uncertainty.covariance.diagonal().cwiseSqrt().cwiseProduct(reduced.sd);
  result.after = found.match.figures(z);
  result.evidence_variance = end.pose.evidence_variance;
  result.complete = end.complete;
  result.failed_solves = reduced.failed_solves;
  result.discrepancy = model_discrepancy(*result.after);
  if (end.states.size() > 1) result.discrepancy.views_mm = disagreement(found.match, end, number);
  result.uncertainty.discrepancy_mm = result.discrepancy.sd_mm();
  result.uncertainty.against_mammogram = true;
  result.uncertainty.edge = reduced.plates_edge(z);
  return result;
}

/// With what no state says of the mammogram.
SearchedView refined(SearchedView found, ViewToSearch& searched, const ViewState& z) {
  found.refinement = refine_view(searched.match, z);
  const ReducedView& reduced = searched.match.view();
  const ViewFrame& frame = searched.solved.view.frame;
  found.compressed = HermiteMesh(in_lps(reduced.nodes_at(z), frame), reduced.elements);
  found.uncertainty.varied = uncertainty(reduced, z, frame).varied;
  found.what_if = what_if_shapes(reduced, z, frame);
  return found;
}

/// What is shown where the search came to nothing: the prediction without it.
SearchedView given_up(SearchedView found, const SearchedView& unsearched) {
  found.view = unsearched.view;
  found.compressed = unsearched.compressed;
  found.baseline = unsearched.baseline;
  found.uncertainty = unsearched.uncertainty;
  found.what_if = unsearched.what_if;
  return found;
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
  std::vector<EdgePrior> edges;
  for (std::size_t v = 0; v < inputs.size(); ++v) {
    const SearchInput& input = inputs[v];
    if (progress) progress(0.3 * v, "sensitivities of " + input.view.name);
    edges.push_back(edge_of(input, nipple_in_lps));
    ReducedView reduced = reduced_view(input);
    reduced.expect(edges.back());
    result.push_back(unmatched(input, reduced, edges.back(), nipple_in_lps));
    if (!input.evidence || !input.solver) continue;
    searched.push_back({ViewMatch(reduced, input.file.faces, prone_of(input.file), &fractions,
                                  nipple_in_lps, input.detector, *input.evidence),
                        &*input.solver,
                        {{}, input.view}});
    places.push_back(v);
    before.push_back(searched.back().match.figures(reduced.mean()));
  }
  const SolvedSearch end = search_and_solve(searched, progress);
  std::vector<SearchedView> found;
  std::vector<SearchVerdict> verdicts;
  std::vector<std::string> names;
  for (std::size_t m = 0; m < searched.size(); ++m) {
    const std::size_t v = places[m];
    found.push_back(matched(inputs[v], searched[m], end, m, edges[v], nipple_in_lps));
    found[m].before = before[m];
    names.push_back(inputs[v].view.name);
    verdicts.push_back(judge_search(names[m], *found[m].after, found[m].state, edges[v],
                                    found[m].complete, found[m].baseline_left));
  }
  judge_together(names, verdicts);
  for (std::size_t m = 0; m < searched.size(); ++m) {
    SearchedView& view = result[places[m]];
    found[m].verdict = verdicts[m];
    view = verdicts[m].end == SearchEnd::no_registration
               ? given_up(std::move(found[m]), view)
               : refined(std::move(found[m]), searched[m], end.states[m]);
  }
  return result;
}

}  // namespace mammotwin
