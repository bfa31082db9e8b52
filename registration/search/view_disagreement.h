#pragma once

#include "registration/search/pose_search.h"

namespace mammotwin {

/// A view's state with what is left unknown of it.
struct KnownState {
  ViewState state;
  Eigen::Matrix<double, kStates, kStates> covariance;
};

/// How much further a view, searched alone, puts tissue from where all views together put it, than
/// the difference of the covariances says (Hausman's test): a standard deviation on the detector
/// in each direction [mm], over the elements' middles.
double view_disagreement(const ViewMatch& match, const KnownState& together,
                         const KnownState& alone);

}  // namespace mammotwin
