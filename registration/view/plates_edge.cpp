#include "registration/view/plates_edge.h"

#include <cmath>
#include <numbers>

namespace mammotwin {

double PlatesEdge::before_mm(const Eigen::Vector2d& place) const {
  const double t = turn_deg * std::numbers::pi / 180;
  return Eigen::Vector2d(std::cos(t), std::sin(t)).dot(place - shift_mm);
}

}  // namespace mammotwin
