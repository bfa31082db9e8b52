#pragma once

#include <vector>

#include "registration/search/view_match.h"

namespace mammotwin {

/// How many observations the evidence's stated standard deviations count as: they were chosen on
/// few patients.
inline constexpr double kOwnObservations = 10;

/// Where a search over all views' states ended. States are in standard deviations.
struct PoseEstimate {
  std::vector<ViewState> states;                                     ///< of each view
  std::vector<Eigen::Matrix<double, kStates, kStates>> covariances;  ///< what is left unknown
  double cost = 0;                                                   ///< half the sum of squares
  /// Of the evidence's differences left, over the one that their standard deviations say, where it
  /// is more (Birge's ratio): these count as kOwnObservations, the mammograms as theirs less the
  /// numbers found from them. Is in the covariances.
  double evidence_variance = 1;
  int iterations = 0;
};

/// The states that are most probable given the mammograms: Levenberg-Marquardt by Ceres on all
/// residuals and z less its prior's mean (a shift in depth beyond two standard deviations by the
/// square root of its distance), some numbers shared by the views. First outline and nipple alone,
/// which lead from far away; then with the pattern of dense tissue. `start` holds a state for each
/// view.
PoseEstimate search_pose(const std::vector<const ViewMatch*>& views,
                         const std::vector<ViewState>& start, bool only_rigid = false);

/// The same without a search: cost and covariances at these states.
PoseEstimate pose_at(const std::vector<const ViewMatch*>& views,
                     const std::vector<ViewState>& states);

/// Before any mammogram: the prior. Without one to lay the breast on, nothing is said of where it
/// lies sideways, only of places in its own frame: then the lateral shift has no variance.
Eigen::Matrix<double, kStates, kStates> prior_covariance();

}  // namespace mammotwin
