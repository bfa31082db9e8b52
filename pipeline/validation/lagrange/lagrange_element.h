#pragma once

#include <vector>

#include "solver/element/solid_element.h"

namespace mammotwin {

/// Lagrange functions of order 1 (trilinear, 8 nodes) or 2 (triquadratic, 27 nodes) on an element:
/// nodes n = n₁ + (order + 1) n₂ + (order + 1)² n₃ at ξᵢ = nᵢ / order. They are tri-cubic
/// polynomials too, so a Lagrange element is the tri-cubic Hermite element with its 64 coefficients
/// tied to fewer nodes,
///
///     c = T q,    T[a, n] = function n (or its derivative) at the corner of Hermite function a
///
/// and energy, residual and tangent follow from the Hermite element's by Tᵀ and T.
class LagrangeElement {
 public:
  /// Throws std::invalid_argument unless order is 1 or 2.
  explicit LagrangeElement(int order);

  int order() const { return order_; }
  int num_nodes() const { return static_cast<int>(T_.cols()); }
  Eigen::Vector3d xi(int node) const;
  const Eigen::MatrixXd& coefficients_from_nodes() const { return T_; }  ///< T, 64 x num_nodes

  /// The pressure space that goes with it: constant, or linear and discontinuous.
  PressureSpace pressure() const {
    return order_ == 1 ? PressureSpace::constant : PressureSpace::linear;
  }

 private:
  int order_;
  Eigen::MatrixXd T_;
};

}  // namespace mammotwin
