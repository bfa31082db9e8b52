#include "solver/contact/plate_contact.h"

namespace mammotwin {

bool PlateContact::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint&, int order,
                           SurfaceResponse& response) const {
  bool touches = false;
  for (std::size_t p = 0; p < plates.size(); ++p) {
    const Gap gap = plates[p].gap(y.head<3>());
    const double t = pressure(gap.gap);
    if (t == 0) continue;
    if (!touches) {
      response.energy = 0;
      response.gradient.head<3>().setZero();
      response.hessian.topLeftCorner<3, 3>().setZero();
    }
    touches = true;
    response.energy += t * t / (2 * penalty);
    response.gradient.head<3>() -= t * gap.normal;
    if (order < 2) continue;
    response.hessian.topLeftCorner<3, 3>() += penalty * gap.normal * gap.normal.transpose();
    response.hessian.topLeftCorner<3, 3>() -= t * gap.hessian;
  }
  return touches;
}

}  // namespace mammotwin
