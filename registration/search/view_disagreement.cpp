#include "registration/search/view_disagreement.h"

#include <cmath>

namespace mammotwin {
namespace {

constexpr double kStateStep = 0.05;  // of a standard deviation

using Places = Eigen::Matrix2Xd;

Places places(const ViewMatch& match, const ViewSamples& samples, const ViewState& z) {
  const ViewSamples::Points x = samples.at(match.view(), z);
  Places on_detector(2, x.cols());
  for (Eigen::Index n = 0; n < x.cols(); ++n)
    on_detector.col(n) = match.detector().project(x.col(n));
  return on_detector;
}

std::vector<MeshPoint> middles(const ReducedView& view) {
  std::vector<MeshPoint> points;
  for (int e = 0; e < static_cast<int>(view.elements.size()); ++e)
    points.push_back({e, Eigen::Vector3d::Constant(0.5)});
  return points;
}

}  // namespace

double view_disagreement(const ViewMatch& match, const KnownState& together,
                         const KnownState& alone) {
  const ViewSamples samples(match.view(), middles(match.view()));
  std::array<Places, kStates> slopes;
  for (int i = 0; i < kStates; ++i) {
    const ViewState step = kStateStep * ViewState::Unit(i);
    slopes[i] = (places(match, samples, together.state + step) -
                 places(match, samples, together.state - step)) /
                (2 * kStateStep);
  }
  const Places off = places(match, samples, alone.state) - places(match, samples, together.state);
  const auto expected = alone.covariance - together.covariance;
  double excess = 0;
  for (Eigen::Index n = 0; n < off.cols(); ++n) {
    Eigen::Matrix<double, 2, kStates> J;
    for (int i = 0; i < kStates; ++i) J.col(i) = slopes[i].col(n);
    excess += off.col(n).squaredNorm() - (J * expected * J.transpose()).trace();
  }
  return std::sqrt(std::max(0.0, excess / (2 * off.cols())));
}

}  // namespace mammotwin
