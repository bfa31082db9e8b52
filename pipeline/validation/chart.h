#pragma once

#include <string>
#include <vector>

#include "pipeline/report/drawing/picture.h"

namespace mammotwin {

/// One axis of a chart: from left to right (or bottom to top), `first` may exceed `last`.
struct ChartAxis {
  std::string label;
  double first = 0, last = 1;
  bool logarithmic = false;  ///< then both are positive, ticks at 1, 2, 5 times powers of ten
};

/// A line chart on white with ticks, in points.
class Chart {
 public:
  Chart(ChartAxis across, ChartAxis up);

  void band(double low, double high, const std::string& name);  ///< of the upward axis
  void line(const Picture::Points& values, const Colour& colour, const std::string& name);
  void marks(const Picture::Points& values, const Colour& colour, const std::string& name);

  const Picture& picture() const { return picture_; }

 private:
  Eigen::Vector2d at(const Eigen::Vector2d& value) const;
  void draw_axes();
  void name_in_legend(const std::string& name, const Colour& colour, bool ring);

  ChartAxis across_, up_;
  Picture picture_;
  int names_ = 0;
};

}  // namespace mammotwin
