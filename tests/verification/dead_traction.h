#pragma once

#include <functional>

#include "solver/element/surface_potential.h"

namespace mammotwin {

/// Traction of fixed direction per reference area: energy = −t(X, N) · x.
class DeadTraction : public SurfacePotential {
 public:
  /// t [kPa] as a function of the reference point.
  using Traction = std::function<Eigen::Vector3d(const SurfacePoint&)>;
  explicit DeadTraction(Traction traction) : traction_(std::move(traction)) {}

  Slots slots() const override { return kPosition; }
  bool respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
               SurfaceResponse& response) const override {
    const Eigen::Vector3d t = traction_(point);
    response.energy = -t.dot(y.head<3>());
    response.gradient.head<3>() = -t;
    if (order == 2) response.hessian.topLeftCorner<3, 3>().setZero();
    return true;
  }

 private:
  Traction traction_;
};

}  // namespace mammotwin
