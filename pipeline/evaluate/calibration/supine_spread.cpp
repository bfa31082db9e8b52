#include "pipeline/evaluate/calibration/supine_spread.h"

#include <algorithm>

namespace mammotwin {

namespace {

Eigen::Vector3d way_of_distance(const WomensLandmark& landmark) {
  return (landmark.supine - landmark.prone) / landmark.prone.norm();
}

}  // namespace

Eigen::Vector3d supine_spread(const std::vector<WomensLandmark>& landmarks) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const WomensLandmark& landmark : landmarks)
    squares += way_of_distance(landmark).cwiseAbs2() / static_cast<double>(landmarks.size());
  return squares.cwiseSqrt();
}

double share_held(const std::vector<WomensLandmark>& landmarks, const Eigen::Vector3d& spread,
                  double times) {
  const auto held = std::count_if(landmarks.begin(), landmarks.end(), [&](const auto& landmark) {
    return way_of_distance(landmark).cwiseQuotient(spread).norm() <= times;
  });
  return static_cast<double>(held) / static_cast<double>(landmarks.size());
}

}  // namespace mammotwin
