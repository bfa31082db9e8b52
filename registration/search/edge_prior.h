#pragma once

#include "fitting/mesh/mesh_file.h"
#include "registration/search/view_state.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {

/// The front of the chest wall as a view sees it near the nipple: a line in the detector's plane.
struct WallLine {
  double depth_mm = 0;   ///< at the nipple's lateral place, in the view's frame
  double slope_deg = 0;  ///< towards depth where lateral grows
};

/// Least squares through the front of the wall's faces, every 5 mm within 40 mm of the nipple
/// sideways. `nipple_in_lps` is in the compressed breast. Throws std::invalid_argument where the
/// wall is not seen there in two places.
WallLine wall_line(const MeshFile& compressed, const CompressedView& view,
                   const Eigen::Vector3d& nipple_in_lps);

/// Where a detector's edge is expected to stand, before the mammogram says, against the plates'
/// own.
///
/// CC: of 2,688 pairs 24.5 % show the pectoral muscle (Strohbach, Wilkinson, Spuur 2020), so the
/// edge stands behind the wall in a quarter; with a mean of 10 mm in front of it, which is the
/// plates' (PlateOptions::wall_clearance), that is a standard deviation of 10 / 0.69 = 14.5 mm.
/// Pairs of views agree better than that (from nipple to edge in CC 3.6 +- 7.2 mm less than from
/// nipple to muscle in MLO, 1,463 pairs, published labels), but where that muscle's edge lies
/// against our wall is not known.
///
/// MLO: body and muscle are pulled onto the detector until the muscle's edge stands 22 +- 6 degrees
/// to the image's (published labels), wide above: the breast is turned. How far our wall then keeps
/// the slope that it has in the view is not known: half of it, give or take that half. The
/// nipple then lies 0.90 +- 0.12 times as deep behind the image's edge as it is far from the
/// muscle's line (15 mammograms whose nipple and muscle somebody read, `evaluate-mammograms`): that
/// line meets the edge some 50 mm above the nipple. Down to its level it reaches in 24.5 % of 200
/// views (Spuur, Poulos, Rickard 2008), where the share is 1.08.
struct EdgePrior {
  ViewState mean = ViewState::Zero();  ///< turn and shift in depth; all else 0 [deg, mm]
  ViewState sd = prior_sd();
  /// Of the numbers over `sd`: a turn is about the nipple, and so goes with a shift.
  Eigen::Matrix<double, kStates, kStates> covariance =
      Eigen::Matrix<double, kStates, kStates>::Identity();
};
EdgePrior edge_prior(const MeshFile& compressed, const CompressedView& view,
                     const Eigen::Vector3d& nipple_in_lps);

}  // namespace mammotwin
