#pragma once

#include "fitting/mesh/mesh_file.h"
#include "registration/search/view_state.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {

/// The front of the chest wall as a view sees it near the nipple: a line in the detector's plane.
struct WallLine {
  double depth_mm = 0;   ///< at the nipple's lateral place, in the view's frame
  double slope_deg = 0;  ///< towards depth where lateral grows

  double depth_at(double aside_mm) const;  ///< from the nipple's lateral place

  /// How far the nipple is from the line, squarely [mm].
  double to_nipple_mm(const Eigen::Vector2d& nipple) const;
};

/// Least squares through the front of the wall's faces, every 5 mm within 40 mm of the nipple
/// sideways. `nipple_in_lps` is in the compressed breast. Throws std::invalid_argument where the
/// wall is not seen there in two places.
WallLine wall_line(const MeshFile& compressed, const CompressedView& view,
                   const Eigen::Vector3d& nipple_in_lps);

/// The shifts in depth and sideways [mm] that lay a breast, turned so on the detector, with its
/// nipple (`nipple_in_lps`, in `pressed`) so deep and its tissue before the edge in the middle.
Eigen::Vector2d shift_of_turned(double turn_deg, const HermiteMesh& pressed,
                                const CompressedView& view, const Eigen::Vector3d& nipple_in_lps,
                                double nipple_depth_mm);

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
/// MLO: body and muscle are pulled onto the detector until what lies above is the deeper. The
/// muscle's line then stands 22 +- 6 degrees to the image's edge (published labels), the chord of
/// the skin beside the nipple 28 +- 15 (12 mammograms that somebody read, `evaluate-mammograms`);
/// between plates that let the breast come out straight it stands at -1 +- 3, whatever the
/// wall's slope. So the breast is turned by 25 +- 12 degrees. The nipple lies 0.90 +- 0.12 times as
/// deep behind the image's edge as it is far from the muscle's line (15 of those mammograms): that
/// line meets the edge some 50 mm above the nipple. The model's own distance is taken to be 10 mm
/// unsure, for its tissue: against breasts drawn of another one (`evaluate-registration --hard`) it
/// was 13 +- 7 mm short. Down to its level the muscle reaches in 24.5 % of 200 views (Spuur,
/// Poulos, Rickard 2008), where the share is 1.08. Sideways the breast's tissue is laid on the
/// detector's middle, however it is turned.
struct EdgePrior {
  ViewState mean = ViewState::Zero();  ///< turn and shifts; all else 0 [deg, mm]
  ViewState sd = prior_sd();           ///< of a shift, beside what goes with the turn
  /// A turn is not about the detector's middle, and so goes with shifts in depth and sideways: sd
  /// of theirs for one of the turn's.
  Eigen::Vector2d shift_by_turn = Eigen::Vector2d::Zero();

  /// How far a state [deg, mm] is off, in `sd`.
  ViewState deviations(const ViewState& state) const;

  /// Of the numbers over `sd`.
  Eigen::Matrix<double, kStates, kStates> covariance() const;
};
EdgePrior edge_prior(const MeshFile& compressed, const CompressedView& view,
                     const Eigen::Vector3d& nipple_in_lps);

}  // namespace mammotwin
