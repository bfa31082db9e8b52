#include "pipeline/evaluate/registration/line_distance.h"

#include <algorithm>

namespace mammotwin {

double distance_to_line(const Eigen::Vector2d& x, const std::vector<Eigen::Vector2d>& line,
                        bool endless) {
  double least = 1e30;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const Eigen::Vector2d way = line[n] - line[n - 1];
    double share = way.dot(x - line[n - 1]) / std::max(1e-12, way.squaredNorm());
    if (!(endless && n == 1)) share = std::max(share, 0.);
    if (!(endless && n + 1 == line.size())) share = std::min(share, 1.);
    least = std::min(least, (x - line[n - 1] - share * way).norm());
  }
  return least;
}

std::vector<Eigen::Vector2d> coarse(const std::vector<Eigen::Vector2d>& curve) {
  constexpr std::size_t kStride = 5;
  std::vector<Eigen::Vector2d> line;
  for (std::size_t n = 0; n + 1 < curve.size(); n += kStride) line.push_back(curve[n]);
  if (!curve.empty()) {
    if (line.size() > 2) line.pop_back();
    line.push_back(curve.back());
  }
  return line;
}

}  // namespace mammotwin
