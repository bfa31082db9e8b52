#pragma once

#include <optional>

#include "fitting/mesh/inverse_map.h"

namespace mammotwin {

/// A point taken from one configuration of the breast to another.
struct CarriedPoint {
  MeshPoint point;        ///< the material point, or the mesh's nearest one
  double outside_mm = 0;  ///< how far the given point lies outside the mesh; 0 inside
  Eigen::Vector3d in_lps = Eigen::Vector3d::Zero();  ///< in the target configuration [mm]
};

/// Where x goes with the material point `beside` it: x = x(xi) + F (X - X(xi)), F = dx/dX.
Eigen::Vector3d carried_beside(const HermiteMesh& from, const HermiteMesh& to,
                               const MeshPoint& beside, const Eigen::Vector3d& x);

/// Carries points between two configurations of one mesh (same elements, other nodes).
/// A point outside the mesh goes with its nearest material point, its offset turned and stretched
/// as the tissue there (carried_beside). Thread-safe once built.
class PointCarrier {
 public:
  /// Throws std::invalid_argument if the two do not have the same elements.
  PointCarrier(const HermiteMesh& from, const HermiteMesh& to);

  CarriedPoint carry(const Eigen::Vector3d& x_in_lps) const;

  /// Nothing where the point lies outside the mesh.
  std::optional<Eigen::Vector3d> carry_inside(const Eigen::Vector3d& x_in_lps) const;

 private:
  HermiteMesh from_, to_;
  InverseMap from_inverse_;
};

}  // namespace mammotwin
