#include "solver/press/plate_way.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mammotwin {

std::string in_mm(double length) {
  std::ostringstream text;
  text.precision(4);
  text << length << " mm";
  return text.str();
}

PlateWay::PlateWay(const PlateFrame& frame, const CompressionProblem& problem, Moving moving)
    : frame_(frame), moving_(moving), tilt_(problem.plates.paddle_tilt) {
  const double thickness = problem.plates.thickness;
  const double extent = frame.free_extent();
  if (!(std::isfinite(thickness) && thickness > 0 && thickness < extent))
    throw std::invalid_argument("thickness is " + in_mm(thickness) +
                                "; expected between 0 and the breast's own " + in_mm(extent) +
                                " along the beam");
  const double middle = frame.centroid_height() + problem.plates.lift;
  end_ = {middle - thickness / 2, middle + thickness / 2};
  const auto [low, high] = frame.touching_heights();
  const bool beside = middle <= low || middle >= high;
  if (beside || (end_.support <= low && end_.paddle >= high))
    throw std::invalid_argument("plates never touch: the breast reaches from " + in_mm(low) +
                                " to " + in_mm(high) + " between plates at " + in_mm(end_.support) +
                                " and " + in_mm(end_.paddle));
  start_ = {std::min(low, end_.support), std::max(high, end_.paddle)};
}

PlateWay::Heights PlateWay::at(double fraction) const {
  double support = fraction, paddle = fraction;
  if (moving_ == Moving::paddle) {
    const double lift = end_.support - start_.support;
    const double share = lift / (lift + start_.paddle - end_.paddle);
    support = fraction < share ? fraction / share : 1;
    paddle = fraction < share ? 0 : (fraction - share) / (1 - share);
  }
  const auto between = [](double a, double b, double f) { return a + f * (b - a); };
  return {between(start_.support, end_.support, support),
          between(start_.paddle, end_.paddle, paddle)};
}

PlacedPlates PlateWay::at(double fraction, double tilt) const {
  const Heights heights = at(fraction);
  return frame_.place(heights.support, heights.paddle, tilt);
}

double PlateWay::fraction_at(double apart) const {
  const double start = start_.paddle - start_.support, end = end_.paddle - end_.support;
  return (start - apart) / (start - end);
}

void PlateWay::end_at(double fraction) { end_ = at(fraction); }

double PlateWay::longest() const {
  const double support = end_.support - start_.support, paddle = start_.paddle - end_.paddle;
  return moving_ == Moving::paddle ? support + paddle : std::max(support, paddle);
}

}  // namespace mammotwin
