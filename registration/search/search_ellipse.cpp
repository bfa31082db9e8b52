#include "registration/search/search_ellipse.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "registration/search/density_map.h"
#include "registration/search/model_discrepancy.h"
#include "registration/search/view_refinement.h"

namespace mammotwin {

namespace {

/// Where a turn and shifts of one standard deviation bring a point of the view.
Eigen::Vector3d placed(const Eigen::Vector3d& x, const ViewState& sd, int number) {
  ReducedView view;
  view.sd = sd;
  return view.placed(x, ViewState::Unit(number));
}

/// A material point of other nodes than a mesh's own.
Eigen::Vector3d position(const Nodes& nodes, const HermiteMesh::Corners& corners,
                         const HermiteMesh::Weights& weights) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int n = 0; n < 8; ++n) x += nodes[corners[n]] * weights.row(n).transpose();
  return x;
}

/// How far a place lies from what the search compares: the image without its rear strip, before
/// the plates' rear edge.
double beside_pattern_mm(const PlatesEdge& edge, const Detector& detector,
                         const Eigen::Vector2d& on_detector) {
  const double before = std::min(on_detector.x(), edge.before_mm(on_detector));
  return std::max({0.0, kPatternInside_mm - before, detector.beside_image_mm(on_detector)});
}

}  // namespace

double unexplained_mm2(const ViewUncertainty& uncertainty, const Detector& detector,
                       const Eigen::Vector2d& on_detector) {
  const double left = uncertainty.discrepancy_mm * uncertainty.discrepancy_mm;
  double fading = 0;
  if (uncertainty.against_mammogram) {
    const double lengths =
        beside_pattern_mm(uncertainty.edge, detector, on_detector) / kDisplacementLength_mm;
    const double uncorrected = kUncorrectedSd_mm * kUncorrectedSd_mm;
    fading = std::max(0.0, uncorrected - left) * (1 - std::exp(-lengths * lengths));
  }
  return kModelSd_mm * kModelSd_mm + left + fading;
}

Eigen::Matrix2d detector_covariance(const ViewUncertainty& uncertainty,
                                    const HermiteMesh& compressed, const CompressedView& view,
                                    const Detector& detector, const MeshPoint& point) {
  const HermiteMesh::Corners& corners = compressed.corners(point.element);
  const HermiteMesh::Weights weights = HermiteMesh::weights(point.xi);
  const Eigen::Vector3d x =
      view.frame.view_from_lps(position(compressed.nodes(), corners, weights));
  const Eigen::Vector2d here = detector.project(x);
  Eigen::Matrix<double, 2, kStates> J = Eigen::Matrix<double, 2, kStates>::Zero();
  for (int i = 0; i < kMechanical; ++i) {
    if (uncertainty.varied[i].empty()) continue;
    const Eigen::Vector3d varied = position(uncertainty.varied[i], corners, weights);
    J.col(i) = detector.project(view.frame.view_from_lps(varied)) - here;
  }
  for (int i = kMechanical; i < kStates; ++i)
    J.col(i) = detector.project(placed(x, uncertainty.sd, i)) - here;
  return J * uncertainty.covariance * J.transpose() +
         unexplained_mm2(uncertainty, detector, here) * Eigen::Matrix2d::Identity();
}

ViewUncertainty without_placement(ViewUncertainty uncertainty) {
  for (int i = kMechanical; i < kStates; ++i) {
    uncertainty.covariance.row(i).setZero();
    uncertainty.covariance.col(i).setZero();
  }
  return uncertainty;
}

double semi_axis_in_sd(double probability) {
  constexpr double n = kOwnObservations;
  return std::sqrt((n - 2) * (std::pow(1 - probability, -2 / n) - 1));
}

SearchEllipse search_ellipse(const Eigen::Matrix2d& covariance, double probability) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance);
  const double scale = semi_axis_in_sd(probability);
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  double angle = std::atan2(major.y(), major.x()) * 180 / std::numbers::pi;
  if (angle <= -90) angle += 180;  // a direction, not an arrow
  if (angle > 90) angle -= 180;
  return {scale * std::sqrt(axes.eigenvalues()[1]), scale * std::sqrt(axes.eigenvalues()[0]),
          angle};
}

std::vector<Eigen::Vector2d> rim(const SearchEllipse& ellipse, int points) {
  const Eigen::Rotation2Dd turn(ellipse.angle_deg * std::numbers::pi / 180);
  std::vector<Eigen::Vector2d> all;
  for (int n = 0; n < points; ++n) {
    const double t = 2 * std::numbers::pi * n / points;
    all.push_back(turn *
                  Eigen::Vector2d(ellipse.major_mm * std::cos(t), ellipse.minor_mm * std::sin(t)));
  }
  return all;
}

bool contains(const SearchEllipse& ellipse, const Eigen::Vector2d& off) {
  const double t = ellipse.angle_deg * std::numbers::pi / 180;
  const double a = (std::cos(t) * off.x() + std::sin(t) * off.y()) / ellipse.major_mm;
  const double b = (std::cos(t) * off.y() - std::sin(t) * off.x()) / ellipse.minor_mm;
  return a * a + b * b <= 1;
}

}  // namespace mammotwin
