#include "pipeline/report/drawing/surface_render.h"

#include <Eigen/Geometry>
#include <cmath>

namespace mammotwin {

Eigen::Matrix3d eye_axes(Side side, double turn, double rise) {
  const double sideways = (side == Side::left ? 1 : -1) * turn;
  const Eigen::Vector3d eye(std::sin(sideways) * std::cos(rise),
                            -std::cos(sideways) * std::cos(rise), std::sin(rise));
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(eye).normalized();
  Eigen::Matrix3d axes;
  axes << right.transpose(), eye.cross(right).transpose(), eye.transpose();
  return axes;
}

Colour shaded(const Colour& base, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, 0.6, 0.7).normalized();
  const double lit = 0.55 + 0.45 * std::abs(normal.dot(light));
  return {base.red * lit, base.green * lit, base.blue * lit, 1};
}

void draw_surface(DepthImage& image, const FaceTriangles& surface, const Eigen::Matrix3d& axes,
                  bool facing, const std::function<Colour(std::size_t)>& colour) {
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    std::array<Eigen::Vector3d, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = axes * surface.points[surface.triangles[i][k]];
    const Eigen::Vector3d normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    if ((normal.z() > 0) != facing) continue;
    image.triangle(x, shaded(colour(i), normal));
  }
}

}  // namespace mammotwin
