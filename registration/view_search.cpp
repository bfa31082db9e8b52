#include "registration/view_search.h"

#include <cmath>
#include <utility>

namespace mammotwin {
namespace {

constexpr int kMostRounds = 5;    // of searching and solving
constexpr int kMostHalvings = 2;  // of a step to a state where no equilibrium is found
constexpr double kTrusted = 0.02; // of the cost: where solve and reduced model differ by less, it ends
constexpr double kLeastGain = 0.01;  // of the cost, by a round

HermiteMesh prone_of(const MeshFile& file) {
  return HermiteMesh(file.configurations.at("prone"), file.mesh.elements());
}

/// The prone breast mapped by the baseline, as a view that can only be turned and shifted.
ReducedView rigid_view(const HermiteMesh& prone, const AffineBaseline& baseline) {
  ReducedView view;
  view.elements = prone.elements();
  view.base = prone.nodes();
  const Eigen::Vector3d zero = baseline.view_from_prone(Eigen::Vector3d::Zero());
  for (HermiteMesh::Node& node : view.base)
    for (int d = 0; d < 8; ++d) {
      const Eigen::Vector3d mapped = baseline.view_from_prone(node.col(d));
      node.col(d) = d == 0 ? mapped : mapped - zero;  // derivatives know no origin
    }
  return view;
}

Eigen::Vector2d shift_of(const ViewState& state) {
  return {state[kShiftDepth], state[kShiftLateral]};
}

AffineBaseline placed_baseline(const SearchInput& input, double thickness_mm,
                               const Eigen::Vector3d& nipple_in_lps) {
  CompressedView view = input.view;
  view.thickness_mm = thickness_mm;
  const HermiteMesh prone = prone_of(input.file);
  AffineBaseline baseline(prone, view);
  if (!input.evidence) return baseline;
  const ViewMatch match(rigid_view(prone, baseline), input.file.faces, prone, nullptr,
                        nipple_in_lps, input.detector, *input.evidence);
  const ViewState state =
      search_pose({&match}, {ViewState::Zero()}, true).states.front().cwiseProduct(prior_sd());
  baseline.place(state[kTurn], shift_of(state));
  return baseline;
}

/// A view's frame once the breast is turned and shifted on the detector.
CompressedView laid_on_detector(CompressedView view, const ViewState& state) {
  view.turn_deg = state[kTurn];
  view.frame.axes = axes_of(view.side, view.angle_deg, view.turn_deg);
  view.frame.origin_in_lps -= view.frame.axes.transpose() *
                              Eigen::Vector3d(state[kShiftDepth], state[kShiftLateral], 0);
  return view;
}

Nodes in_lps(Nodes nodes, const ViewFrame& frame) {
  for (HermiteMesh::Node& node : nodes) {
    node = (frame.axes.transpose() * node).eval();
    node.col(0) += frame.origin_in_lps;
  }
  return nodes;
}

class ViewsSearch {
 public:
  ViewsSearch(const std::vector<SearchInput>& inputs, const Volume<Fractions>& fractions,
              const Eigen::Vector3d& nipple_in_lps, const Progress& progress)
      : inputs_(inputs), nipple_in_lps_(nipple_in_lps), progress_(progress) {
    for (std::size_t v = 0; v < inputs.size(); ++v) {
      say(0.3 * v, "sensitivities of " + inputs[v].view.name);
      reduced_.push_back(reduced(inputs[v]));
      reduced_.back().elements = inputs[v].file.mesh.elements();
      solved_.push_back({{}, inputs[v].view});
    }
    for (std::size_t v = 0; v < inputs.size(); ++v)
      if (inputs[v].evidence && inputs[v].solver) add_match(v, fractions);
    states_.assign(matches_.size(), ViewState::Zero());
  }

  std::vector<SearchedView> run() {
    std::vector<MatchFigures> before;
    for (const ViewMatch& match : matches_) before.push_back(match.figures(ViewState::Zero()));
    const PoseEstimate found = find_pose();
    std::vector<SearchedView> result;
    for (std::size_t v = 0; v < inputs_.size(); ++v) result.push_back(unmatched(v));
    for (std::size_t m = 0; m < matches_.size(); ++m)
      result[numbers_[m]] = matched(m, before[m], found);
    return result;
  }

 private:
  void say(double fraction, const std::string& what) const {
    if (progress_) progress_(fraction, what);
  }

  static ReducedView reduced(const SearchInput& input) {
    if (!input.solver) return unsolved(input);
    return input.evidence ? reduce_view(*input.solver, prior_sd())
                          : linear_view(*input.solver, prior_sd());
  }

  static ReducedView unsolved(const SearchInput& input) {
    ReducedView view;
    view.elements = input.file.mesh.elements();
    view.base = in_view(input.file.mesh.nodes(), input.view.frame);
    view.failed_solves = 2 * kMechanical;
    return view;
  }

  void add_match(std::size_t v, const Volume<Fractions>& fractions) {
    const SearchInput& input = inputs_[v];
    matches_.emplace_back(reduced_[v], input.file.faces, prone_of(input.file), &fractions,
                          nipple_in_lps_, input.detector, *input.evidence);
    numbers_.push_back(v);
  }

  std::vector<const ViewMatch*> pointers() const {
    std::vector<const ViewMatch*> all;
    for (const ViewMatch& match : matches_) all.push_back(&match);
    return all;
  }

  /// States with what was solved there.
  struct Place {
    std::vector<ViewState> states;
    std::vector<ReducedView> reduced;  ///< about them
    std::vector<SolvedView> solved;
    double cost = 0;
  };

  /// A search on the reduced models, a solve where it ends, the models shifted to meet that, and
  /// again. From the second round on only half of the way is gone: the shift is another at the
  /// search's new end, and full steps were seen to go to and fro about where they should have ended.
  /// The best solve is what counts; its states and models are left behind.
  PoseEstimate find_pose() {
    if (matches_.empty()) return {};
    Place best = first_place(), here = best;
    for (int round = 0; round < kMostRounds; ++round) {
      say(0.65 + 0.15 * round / kMostRounds, "search");
      const PoseEstimate aim = search_pose(pointers(), here.states);
      const std::vector<ViewState> end = round == 0 ? aim.states : middle(aim.states, here.states);
      if (!go_towards(end, best, here)) break;
      const bool gained = here.cost < (1 - kLeastGain) * best.cost;
      if (here.cost < best.cost) best = here;
      if (!gained || here.cost < (1 + kTrusted) * aim.cost) break;
    }
    stand_at(best);
    return pose_at(pointers(), states_);
  }

  static std::vector<ViewState> middle(std::vector<ViewState> a, const std::vector<ViewState>& b) {
    for (std::size_t m = 0; m < a.size(); ++m) a[m] = (a[m] + b[m]) / 2;
    return a;
  }

  Place first_place() const {
    Place place{states_, {}, {}, pose_at(pointers(), states_).cost};
    for (std::size_t m = 0; m < matches_.size(); ++m) {
      place.reduced.push_back(matches_[m].view());
      place.solved.push_back(solved_[numbers_[m]]);
    }
    return place;
  }

  /// Solves at `aim`, or nearer to the best where that fails; false if all fails.
  bool go_towards(std::vector<ViewState> aim, const Place& best, Place& here) {
    for (int halving = 0; halving <= kMostHalvings; ++halving) {
      if (solve_at(aim, here)) {
        stand_at(here);
        here.cost = pose_at(pointers(), states_).cost;
        return true;
      }
      aim = middle(aim, best.states);
    }
    complete_ = false;
    return false;
  }

  bool solve_at(const std::vector<ViewState>& states, Place& place) const {
    Place there{states, {}, {}, 0};
    for (std::size_t m = 0; m < matches_.size(); ++m) {
      const NearbySolver& solver = *inputs_[numbers_[m]].solver;
      ReducedView reduced = matches_[m].view();
      const ViewState state = states[m].cwiseProduct(reduced.sd);
      const auto solved = solver.solve(state);
      if (!solved) return false;
      reduced.rebase(states[m], in_view(solved->result.deformed, solved->view.frame));
      there.reduced.push_back(std::move(reduced));
      there.solved.push_back(*solved);
    }
    place = std::move(there);
    return true;
  }

  void stand_at(const Place& place) {
    states_ = place.states;
    for (std::size_t m = 0; m < matches_.size(); ++m) {
      matches_[m].renew(place.reduced[m]);
      solved_[numbers_[m]] = place.solved[m];
    }
  }

  SearchedView unmatched(std::size_t v) const {
    const SearchInput& input = inputs_[v];
    SearchedView result{input.view, input.file.mesh,
                        placed_baseline(input, input.view.thickness_mm, nipple_in_lps_)};
    result.uncertainty = uncertainty(reduced_[v], ViewState::Zero(), input.view.frame);
    result.failed_solves = reduced_[v].failed_solves;
    return result;
  }

  ViewUncertainty uncertainty(const ReducedView& reduced, const ViewState& z,
                              const ViewFrame& frame) const {
    ViewUncertainty result;
    result.sd = reduced.sd;
    for (int i = 0; i < kMechanical; ++i)
      if (!reduced.modes[i].linear.empty())
        result.varied[i] = in_lps(reduced.nodes_along_slope(z, i), frame);
    return result;
  }

  SearchedView matched(std::size_t m, const MatchFigures& before,
                       const PoseEstimate& found) const {
    const auto& covariance = found.covariances[m];
    const std::size_t v = numbers_[m];
    const ReducedView& reduced = matches_[m].view();
    const ViewState state = states_[m].cwiseProduct(reduced.sd);
    const CompressedView view = solved_[v].view;
    const HermiteMesh compressed(in_lps(reduced.nodes_at(states_[m]), view.frame),
                                 reduced.elements);
    SearchedView result{laid_on_detector(view, state), compressed,
                        placed_baseline(inputs_[v], view.thickness_mm, nipple_in_lps_)};
    result.uncertainty = uncertainty(reduced, states_[m], view.frame);
    result.uncertainty.covariance = covariance;
    result.state = state;
    result.state_sd = covariance.diagonal().cwiseSqrt().cwiseProduct(reduced.sd);
    result.before = before;
    result.after = matches_[m].figures(states_[m]);
    result.evidence_variance = found.evidence_variance;
    result.complete = complete_;
    result.failed_solves = reduced.failed_solves;
    return result;
  }

  const std::vector<SearchInput>& inputs_;
  Eigen::Vector3d nipple_in_lps_;
  const Progress& progress_;
  std::vector<ReducedView> reduced_;
  std::vector<SolvedView> solved_;
  std::vector<ViewMatch> matches_;
  std::vector<std::size_t> numbers_;  ///< of the view of each match
  std::vector<ViewState> states_;
  bool complete_ = true;
};

}  // namespace

std::vector<SearchedView> search_views(const std::vector<SearchInput>& inputs,
                                       const Volume<Fractions>& fractions,
                                       const Eigen::Vector3d& nipple_in_lps,
                                       const Progress& progress) {
  return ViewsSearch(inputs, fractions, nipple_in_lps, progress).run();
}

}  // namespace mammotwin
