#include "registration/search/solved_search.h"

#include <algorithm>
#include <utility>

namespace mammotwin {
namespace {

constexpr int kMostRounds = 5;           // of searching and solving
constexpr double kShortestStep = 0.125;  // of a way on which no equilibrium is found in one
constexpr double kTrusted =
    0.02;  // of the cost: where solve and reduced model differ by less, it ends
constexpr double kLeastGain = 0.01;  // of the cost, by a round

using States = std::vector<ViewState>;

States between(States a, const States& b, double share) {
  for (std::size_t v = 0; v < a.size(); ++v) a[v] += share * (b[v] - a[v]);
  return a;
}

/// States with what was solved there.
struct Place {
  States states;
  std::vector<ReducedView> reduced;  ///< about them
  std::vector<SolvedView> solved;
  double cost = 0;
};

class Rounds {
 public:
  Rounds(std::vector<ViewToSearch>& views, const Progress& progress)
      : views_(views), progress_(progress) {
    for (const ViewToSearch& view : views) matches_.push_back(&view.match);
  }

  SolvedSearch run() {
    SolvedSearch end;
    if (views_.empty()) return end;
    Place best = start(), here = best;
    for (int round = 0; round < kMostRounds; ++round) {
      if (progress_) progress_(0.65 + 0.15 * round / kMostRounds, "search");
      const PoseEstimate aim = search_pose(matches_, here.states);
      const States next = round == 0 ? aim.states : between(here.states, aim.states, 0.5);
      end.complete = go_towards(next, here);
      if (!end.complete) break;
      const bool gained = here.cost < (1 - kLeastGain) * best.cost;
      if (here.cost < best.cost) best = here;
      if (!gained || here.cost < (1 + kTrusted) * aim.cost) break;
    }
    stand_at(best);
    end.states = best.states;
    end.pose = pose_at(matches_, best.states);
    return end;
  }

 private:
  Place start() const {
    Place place;
    for (const ViewToSearch& view : views_) {
      place.states.push_back(view.match.view().mean());
      place.reduced.push_back(view.match.view());
      place.solved.push_back(view.solved);
    }
    place.cost = pose_at(matches_, place.states).cost;
    return place;
  }

  /// Solves at `aim`, or on the way there as far as all views come; false if one does not move.
  bool go_towards(const States& aim, Place& here) {
    std::vector<Walk> walks = walks_to(aim, here);
    double share = 1;
    for (const Walk& walk : walks) share = std::min(share, walk.share);
    if (share == 0) return false;
    const States reached = between(here.states, aim, share);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      if (walks[v].share == share) continue;
      walks[v] = walk_to(v, reached[v], here);
      if (walks[v].share < 1) return false;
    }
    here = solved_place(reached, walks);
    stand_at(here);
    here.cost = pose_at(matches_, here.states).cost;
    return true;
  }

  std::vector<Walk> walks_to(const States& aim, const Place& here) const {
    std::vector<Walk> walks(views_.size());
    for (std::size_t v = 0; v < views_.size(); ++v) walks[v] = walk_to(v, aim[v], here);
    return walks;
  }

  /// From where the search began, so that what is found depends on the state alone; where that
  /// fails, from `here`.
  Walk walk_to(std::size_t v, const ViewState& aim, const Place& here) const {
    const NearbySolver& solver = *views_[v].solver;
    const ViewState& sd = views_[v].match.view().sd;
    if (!solver.soft_base()) return {};
    const ViewState to = aim.cwiseProduct(sd);
    if (here.states[v].head<kMechanical>().isZero()) return solver.walk_to(to, kShortestStep);
    if (Walk walk = solver.walk_to(to); walk.share == 1) return walk;
    return solver.walk_from(here.solved[v], here.states[v].cwiseProduct(sd), to, kShortestStep);
  }

  Place solved_place(const States& states, const std::vector<Walk>& walks) const {
    Place place{states, {}, {}, 0};
    for (std::size_t v = 0; v < views_.size(); ++v) {
      ReducedView reduced = views_[v].match.view();
      const SolvedView& solved = walks[v].end;
      reduced.rebase(states[v], in_view(solved.result.deformed, solved.view.frame));
      place.reduced.push_back(std::move(reduced));
      place.solved.push_back(solved);
    }
    return place;
  }

  void stand_at(const Place& place) {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      views_[v].match.renew(place.reduced[v]);
      views_[v].solved = place.solved[v];
    }
  }

  std::vector<ViewToSearch>& views_;
  const Progress& progress_;
  std::vector<const ViewMatch*> matches_;
};

}  // namespace

SolvedSearch search_and_solve(std::vector<ViewToSearch>& views, const Progress& progress) {
  return Rounds(views, progress).run();
}

}  // namespace mammotwin
