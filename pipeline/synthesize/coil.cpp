#include "pipeline/synthesize/coil.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {

using Eigen::Vector3d;
using Eigen::Vector3i;

Coil::Coil(std::vector<Vector3d> loops, double radius_mm, const Vector3d& reference)
    : loops_(std::move(loops)), squared_radius_(radius_mm * radius_mm) {
  scale_ = 1 / raw(reference);
}

double Coil::raw(const Vector3d& x) const {
  constexpr double power = 1.2;
  double sum = 0;
  for (const Vector3d& loop : loops_)
    sum += std::pow(squared_radius_ / (squared_radius_ + (x - loop).squaredNorm()), 2 * power);
  return std::sqrt(sum);
}

double Coil::sensitivity(const Vector3d& x) const { return scale_ * raw(x); }

Volume<float> Coil::shading(const Volume<float>& grid, double exponent) const {
  constexpr double node_mm = 6;
  const Vector3d extent = grid.spacing.cwiseProduct((grid.size - Vector3i::Ones()).cast<double>());
  const Vector3i size = (extent / node_mm).cast<int>() + Vector3i::Constant(2);
  Volume<double> nodes(size, Vector3d::Constant(node_mm), grid.origin);
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        nodes(i, j, k) = std::pow(sensitivity(nodes.position(i, j, k)), exponent);
  });
  Volume<float> shading = grid.like<float>();
  tbb::parallel_for(0, grid.size.z(), [&](int k) {
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) {
        const Vector3d at = nodes.index(grid.position(i, j, k));
        const Vector3i b = at.cast<int>().cwiseMin(size - Vector3i::Constant(2));
        const Vector3d f = at - b.cast<double>();
        double sum = 0;
        for (int c = 0; c < 8; ++c)
          sum += (c & 1 ? f.x() : 1 - f.x()) * (c & 2 ? f.y() : 1 - f.y()) *
                 (c & 4 ? f.z() : 1 - f.z()) *
                 nodes(b.x() + (c & 1), b.y() + ((c >> 1) & 1), b.z() + (c >> 2));
        shading(i, j, k) = static_cast<float>(sum);
      }
  });
  return shading;
}

Coil coil_round(const Chest& chest, Side side, double radius_mm) {
  constexpr double gap_mm = 22;  // from the skin to the loop
  std::vector<Vector3d> loops;
  for (const Side s : {Side::left, Side::right}) {
    const BreastShape& b = chest.breast(s);
    const Vector3d middle = b.axis(0.45);
    const Vector3d across((b.width + gap_mm), 0, 0), along(0, 0, b.height + gap_mm);
    for (const Vector3d& offset : {across, along}) {
      loops.push_back(middle + offset);
      loops.push_back(middle - offset);
    }
  }
  return Coil(std::move(loops), radius_mm, chest.breast(side).axis(0.4));
}

}  // namespace mammotwin
