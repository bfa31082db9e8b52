#pragma once

#include "registration/search/pose_search.h"
#include "registration/view/plates_edge.h"

namespace mammotwin {

/// An ellipse on the detector that holds the true position with a stated probability.
struct SearchEllipse {
  double major_mm = 0, minor_mm = 0;  ///< semi-axes
  double angle_deg = 0;               ///< of the major axis, from u towards v
};

/// What no state explains, in each direction on the detector [mm]: a place in an MRI of 1.2 mm is
/// known to a voxel, whose uniform law has a standard deviation of 1.2 / sqrt(12). The marks of
/// synthetic patients ask for no more (pipeline/evaluate/README.md).
inline constexpr double kModelSd_mm = 0.35;

/// A registered view with what is not known of its state.
struct ViewUncertainty {
  /// The breast with one mechanical number a standard deviation further along the slope that the
  /// covariance was found with, as it stands in the registered view's frame, in LPS [mm]; empty: no
  /// effect.
  std::array<Nodes, kMechanical> varied;
  ViewState sd = prior_sd();
  Eigen::Matrix<double, kStates, kStates> covariance = prior_covariance();  ///< of z [-]
  /// What is left unexplained besides kModelSd_mm, on the detector, the same in each direction
  /// [mm]; model_discrepancy.h.
  double discrepancy_mm = 0;
  bool against_mammogram = false;  ///< that is what a search left, and so of tissue in the image
  PlatesEdge edge;                 ///< where a search found it
};

/// Variance in each direction [mm^2] at a place on the detector that no state explains:
/// kModelSd_mm^2 + discrepancy_mm^2. What a mammogram shows of the model's displacements says the
/// less of tissue the farther that lies (d) from where its pattern is compared (density_map.h):
/// they correlate by exp(-d^2 / 2 L^2), L = 30 mm (view_refinement.h), so 1 - exp(-d^2 / L^2) of
/// the way the variance becomes that of a prediction that none corrects.
double unexplained_mm2(const ViewUncertainty& uncertainty, const Detector& detector,
                       const Eigen::Vector2d& on_detector);

/// Covariance on the detector [mm^2] of a material point: J C J^T + unexplained_mm2, J being the
/// slopes times a standard deviation.
Eigen::Matrix2d detector_covariance(const ViewUncertainty& uncertainty,
                                    const HermiteMesh& compressed, const CompressedView& view,
                                    const Detector& detector, const MeshPoint& point);

/// The same where turn and shifts on the detector are none: for the model's own picture of a view
/// without a mammogram, in which the breast lies where it is drawn.
ViewUncertainty without_placement(ViewUncertainty uncertainty);

/// Semi-axes over standard deviations of the ellipse that holds p. Variances are not known but
/// estimated, from as much as n = kOwnObservations tell, so places follow Student's law with n
/// degrees of freedom about them: sqrt((n - 2) ((1 - p)^(-2/n) - 1)); 1.09 and 2.16 for 0.5 and
/// 0.9, where a normal law has 1.18 and 2.15.
double semi_axis_in_sd(double probability);

/// The ellipse of that probability (0.5, 0.9).
SearchEllipse search_ellipse(const Eigen::Matrix2d& covariance, double probability);

/// Points of the ellipse, from its middle, evenly in its own angle.
std::vector<Eigen::Vector2d> rim(const SearchEllipse& ellipse, int points);

/// True inside it; `off` from its middle [mm].
bool contains(const SearchEllipse& ellipse, const Eigen::Vector2d& off);

}  // namespace mammotwin
