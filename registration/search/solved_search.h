#pragma once

#include "registration/search/pose_search.h"
#include "solver/progress.h"

namespace mammotwin {

/// A view with a mammogram, as the search takes it.
struct ViewToSearch {
  ViewMatch match;  ///< of the reduced model that starts the search
  const NearbySolver* solver;
  SolvedView solved;  ///< the compression that there is
};

/// Where search and solves ended: `match` and `solved` of each view are what was solved there.
struct SolvedSearch {
  std::vector<ViewState> states;  ///< of each view [standard deviations]
  PoseEstimate pose;              ///< cost and what is left unknown there
  bool complete = true;  ///< false: it stopped where no equilibrium was found, at its best so far
};

/// A search on the reduced models, a solve where it ends, the models shifted to meet that, and
/// again, until the solves bear out what the reduced models said or get no better. From the second
/// round on only half of the way is gone: the shift is another at the search's new end, and full
/// steps were seen to go to and fro about where they should have ended. Where a view finds no
/// equilibrium on the way, all go as far as it comes, and the search goes on from there. The best
/// solve is what counts.
SolvedSearch search_and_solve(std::vector<ViewToSearch>& views, const Progress& progress);

}  // namespace mammotwin
