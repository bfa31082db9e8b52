#include "registration/solved_search.h"

#include <utility>

namespace mammotwin {
namespace {

constexpr int kMostRounds = 5;       // of searching and solving
constexpr int kMostHalvings = 2;     // of a step to a state where no equilibrium is found
constexpr double kTrusted = 0.02;    // of the cost: where solve and reduced model differ by less, it ends
constexpr double kLeastGain = 0.01;  // of the cost, by a round

using States = std::vector<ViewState>;

States middle(States a, const States& b) {
  for (std::size_t v = 0; v < a.size(); ++v) a[v] = (a[v] + b[v]) / 2;
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
      const States next = round == 0 ? aim.states : middle(aim.states, here.states);
      end.complete = go_towards(next, best, here);
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
    Place place{States(views_.size(), ViewState::Zero()), {}, {}, 0};
    place.cost = pose_at(matches_, place.states).cost;
    for (const ViewToSearch& view : views_) {
      place.reduced.push_back(view.match.view());
      place.solved.push_back(view.solved);
    }
    return place;
  }

  /// Solves at `aim`, or nearer to the best where that fails; false if all fails.
  bool go_towards(States aim, const Place& best, Place& here) {
    for (int halving = 0; halving <= kMostHalvings; ++halving) {
      if (solve_at(aim, here)) {
        stand_at(here);
        here.cost = pose_at(matches_, here.states).cost;
        return true;
      }
      aim = middle(aim, best.states);
    }
    return false;
  }

  bool solve_at(const States& states, Place& place) const {
    Place there{states, {}, {}, 0};
    for (std::size_t v = 0; v < views_.size(); ++v) {
      ReducedView reduced = views_[v].match.view();
      const auto solved = views_[v].solver->solve(states[v].cwiseProduct(reduced.sd));
      if (!solved) return false;
      reduced.rebase(states[v], in_view(solved->result.deformed, solved->view.frame));
      there.reduced.push_back(std::move(reduced));
      there.solved.push_back(*solved);
    }
    place = std::move(there);
    return true;
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
