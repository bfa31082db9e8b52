#include "registration/view/breast_position.h"

#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

std::string hour_of(double left, double up) {
  const double degrees = std::atan2(left, up) * 180 / std::numbers::pi;
  const int hour = static_cast<int>(std::lround((degrees < 0 ? degrees + 360 : degrees) / 30)) % 12;
  return std::to_string(hour == 0 ? 12 : hour);
}

}  // namespace

BreastPosition breast_position(Side side, const Eigen::Vector3d& x_in_lps,
                               const Eigen::Vector3d& nipple_in_lps) {
  const double left = x_in_lps.x() - nipple_in_lps.x();
  const double up = x_in_lps.z() - nipple_in_lps.z();
  if (std::hypot(left, up) < kCentralRadius_mm) return {"central", ""};
  const bool outer = (side == Side::left) == (left > 0);
  return {std::string(up > 0 ? "upper" : "lower") + (outer ? " outer" : " inner"),
          hour_of(left, up)};
}

}  // namespace mammotwin
