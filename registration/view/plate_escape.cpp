#include "registration/view/plate_escape.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

constexpr int kSamples = 4;  // in each direction of an element

/// Sums over points that stand for volumes, from which their affine map follows.
struct AffineSums {
  double volume = 0;
  Eigen::Vector3d X = Eigen::Vector3d::Zero(), x = Eigen::Vector3d::Zero();
  Eigen::Matrix3d XX = Eigen::Matrix3d::Zero(), xX = Eigen::Matrix3d::Zero();

  void add(double v, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    volume += v;
    X += v * from;
    x += v * to;
    XX += v * from * from.transpose();
    xX += v * to * from.transpose();
  }
  Eigen::Matrix3d rotation() const {
    const Eigen::Matrix3d spread = XX - X * X.transpose() / volume;
    const Eigen::Matrix3d map = (xX - x * X.transpose() / volume) * spread.inverse();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(map, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return svd.matrixU() * svd.matrixV().transpose();
  }
};

}  // namespace

PlateEscape plate_escape(const HermiteMesh& found, const HermiteMesh& pressed,
                         const MeshPoint& nipple, const ViewFrame& view) {
  AffineSums between;
  double in_front = 0, forward = 0;
  for (int e = 0; e < found.num_elements(); ++e)
    for (int n = 0; n < kSamples * kSamples * kSamples; ++n) {
      const Eigen::Vector3d number(n % kSamples, n / kSamples % kSamples,
                                   n / (kSamples * kSamples));
      const MeshPoint p{e, (number.array() + 0.5) / kSamples};
      const Eigen::Vector3d X = view.view_from_lps(found.position(p));
      const Eigen::Vector3d x = view.view_from_lps(pressed.position(p));
      const double volume = found.jacobian(p).determinant();
      if (x.x() > 0) between.add(volume, X, x);
      if (X.x() > 0) in_front += volume, forward += volume * (x.x() - X.x());
    }
  const double kept = between.volume > 0 ? between.rotation()(2, 2) : 1;
  const Eigen::Vector3d moved = pressed.position(nipple) - found.position(nipple);
  return {view.axes.row(1).dot(moved),
          std::acos(std::clamp(kept, -1.0, 1.0)) * 180 / std::numbers::pi,
          in_front > 0 ? std::max(0.0, -forward / in_front) : 0};
}

}  // namespace mammotwin
