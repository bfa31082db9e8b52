#include "solver/contact/plate_contact.h"

namespace mammotwin {

bool PlateContact::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint&, int order,
                           SurfaceResponse& response) const {
  bool touches = false;
  for (const Plate& plate : plates) {
    const Gap gap = plate.gap(y.head<3>());
    if (gap.gap >= 0) continue;
    if (!touches) {
      response.energy = 0;
      response.gradient.head<3>().setZero();
      response.hessian.topLeftCorner<3, 3>().setZero();
    }
    touches = true;
    response.energy += penalty / 2 * gap.gap * gap.gap;
    response.gradient.head<3>() += penalty * gap.gap * gap.normal;
    if (order < 2) continue;
    response.hessian.topLeftCorner<3, 3>() +=
        penalty * (gap.normal * gap.normal.transpose() + gap.gap * gap.hessian);
  }
  return touches;
}

}  // namespace mammotwin
