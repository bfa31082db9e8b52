#include "registration/view/view_frame.h"

#include <cmath>
#include <numbers>

namespace mammotwin {

Eigen::Matrix3d view_axes(Side side, double angle_deg) {
  const double t = angle_deg * std::numbers::pi / 180;
  const double s = side == Side::left ? 1 : -1;
  Eigen::Matrix3d axes;
  axes.row(0) << 0, -1, 0;
  axes.row(1) << s * std::cos(t), 0, std::sin(t);
  axes.row(2) << -s * std::sin(t), 0, std::cos(t);
  return axes;
}

bool is_oblique(double angle_deg) { return std::abs(angle_deg) >= 15; }

}  // namespace mammotwin
