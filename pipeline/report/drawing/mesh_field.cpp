#include "pipeline/report/drawing/mesh_field.h"

#include <stdexcept>

namespace mammotwin {
namespace {

/// Cubic Bernstein polynomials at t.
std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

}  // namespace

MeshField::MeshField(const HermiteMesh& mesh, PointField field)
    : bezier_(mesh), field_(std::move(field)) {
  if (field_.components != 1 || field_.values.size() != bezier_.points.size())
    throw std::invalid_argument("mesh field: expected one number a control point");
}

double MeshField::at(const MeshPoint& point) const {
  const auto a = bernstein(point.xi.x()), b = bernstein(point.xi.y()), c = bernstein(point.xi.z());
  const std::array<int, 64>& element = bezier_.elements[point.element];
  double sum = 0;
  for (int m = 0; m < 64; ++m)
    sum += a[m % 4] * b[m / 4 % 4] * c[m / 16] * field_.values[element[m]];
  return sum;
}

}  // namespace mammotwin
