#include "registration/view/breast_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

std::string hour_of(double left, double up) {
  const double degrees = std::atan2(left, up) * 180 / std::numbers::pi;
  const int hour = static_cast<int>(std::lround((degrees < 0 ? degrees + 360 : degrees) / 30)) % 12;
  return std::to_string(hour == 0 ? 12 : hour);
}

/// Where the breast ends straight behind the nipple [mm, LPS y]; the nipple's own place if nowhere.
double back_behind_nipple(const Segmentation& s) {
  Eigen::Vector3i v = s.labels.index(s.nipple_in_lps).array().round().cast<int>();
  double back = s.nipple_in_lps.y();
  for (v.y() = std::max(v.y(), 0); s.labels.contains(v.x(), v.y(), v.z()); ++v.y()) {
    const std::uint8_t value = s.labels(v.x(), v.y(), v.z());
    if (value == label::muscle) break;
    if (label::is_breast(value)) back = s.labels.position(v.x(), v.y(), v.z()).y();
  }
  return back;
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

std::string depth_third(const Segmentation& segmentation, const Eigen::Vector3d& x_in_lps) {
  const double front = segmentation.nipple_in_lps.y();
  const double depth = back_behind_nipple(segmentation) - front;
  if (depth <= 0) return "";
  const double share = (x_in_lps.y() - front) / depth;
  return share < 1.0 / 3 ? "anterior" : share < 2.0 / 3 ? "middle" : "posterior";
}

}  // namespace mammotwin
