#include "registration/carry/point_carrier.h"

#include <Eigen/LU>
#include <stdexcept>

namespace mammotwin {

Eigen::Vector3d carried_beside(const HermiteMesh& from, const HermiteMesh& to,
                               const MeshPoint& beside, const Eigen::Vector3d& x) {
  const Eigen::Matrix3d F = to.jacobian(beside) * from.jacobian(beside).inverse();
  return to.position(beside) + F * (x - from.position(beside));
}

PointCarrier::PointCarrier(const HermiteMesh& from, const HermiteMesh& to)
    : from_(from), to_(to), from_inverse_(from_) {
  if (from.elements() != to.elements() || from.num_nodes() != to.num_nodes())
    throw std::invalid_argument(
        "point carrier: the two configurations do not belong to one mesh (their elements differ)");
}

CarriedPoint PointCarrier::carry(const Eigen::Vector3d& x_in_lps) const {
  if (const auto inside = from_inverse_.locate(x_in_lps))
    return {*inside, 0, to_.position(*inside)};
  const MeshPoint nearest = from_inverse_.nearest(x_in_lps);
  return {nearest, (x_in_lps - from_.position(nearest)).norm(),
          carried_beside(from_, to_, nearest, x_in_lps)};
}

std::optional<Eigen::Vector3d> PointCarrier::carry_inside(const Eigen::Vector3d& x_in_lps) const {
  const auto inside = from_inverse_.locate(x_in_lps);
  if (!inside) return std::nullopt;
  return to_.position(*inside);
}

}  // namespace mammotwin
