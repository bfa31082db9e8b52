#include "registration/view/plate_turn.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "registration/view/wall_samples.h"

namespace mammotwin {
namespace {

constexpr double kBehindNipple_mm = 60;  // of the wall, what counts most
constexpr int kFaceSamples = 6;          // along a face's side

/// Of a sample's share of a face, into the breast [mm²].
Eigen::Vector3d area_vector(const HermiteMesh& mesh, const WallSample& sample) {
  const auto& [at, face] = sample;
  const int i = face / 2;
  const Eigen::Matrix3d J = mesh.jacobian(at);
  const Eigen::Vector3d outwards =
      (face % 2 == 1 ? 1 : -1) * J.col((i + 1) % 3).cross(J.col((i + 2) % 3));
  return -outwards / (kFaceSamples * kFaceSamples);
}

/// From lateral towards depth.
double turn_of(const Eigen::Vector3d& direction_in_view) {
  if (!(direction_in_view.x() > 0))
    throw std::invalid_argument(
        "no chest wall lies behind the nipple: plates have none to stand by");
  return -std::atan2(direction_in_view.y(), direction_in_view.x()) * 180 / std::numbers::pi;
}

}  // namespace

double straight_turn_deg(const MeshFile& unloaded, const MeshPoint& nipple,
                         const Eigen::Matrix3d& view_axes) {
  const Eigen::Vector3d tip = unloaded.mesh.position(nipple);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), normal = moment;
  double area = 0;
  for (const WallSample& sample : wall_samples(unloaded, kFaceSamples)) {
    const Eigen::Vector3d x = unloaded.mesh.position(sample.at);
    const Eigen::Vector3d piece = area_vector(unloaded.mesh, sample);
    const double r = (x - tip).norm() / kBehindNipple_mm;
    normal += std::exp(-r * r / 2) * piece;
    moment += piece.norm() * x;
    area += piece.norm();
  }
  if (area == 0)
    throw std::invalid_argument(
        "the mesh has no face labelled chest_wall; the plates are turned by the wall");
  return (turn_of(view_axes * normal) + turn_of(view_axes * (tip - moment / area))) / 2;
}

double usual_turn_deg(const MeshFile& unloaded, const MeshPoint& nipple, Side side,
                      double angle_deg) {
  return straight_turn_deg(unloaded, nipple, view_axes(side, angle_deg));
}

Eigen::Matrix3d usual_axes(const MeshFile& unloaded, const MeshPoint& nipple, Side side,
                           double angle_deg) {
  return axes_of(side, angle_deg, usual_turn_deg(unloaded, nipple, side, angle_deg));
}

}  // namespace mammotwin
