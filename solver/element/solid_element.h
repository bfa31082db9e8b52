#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "solver/element/convex_part.h"
#include "solver/element/tensor_basis.h"
#include "solver/material/material.h"

namespace mammotwin {

/// Pressure of an element, discontinuous between elements; the value is its number of unknowns.
/// Inf-sup and accuracy: solver/README.md.
enum class PressureSpace { constant = 1, linear = 4, trilinear = 8 };

struct SolidOptions {
  PressureSpace pressure = PressureSpace::trilinear;
  double bulk_ratio = 1e4;  ///< κ/μ [-], at least 100; 1e4 costs 0.01 % in force
  double grad_div = 5;      ///< γ/μ [-], at least 0; keeps J near 1 where stiffness jumps
  double quartic = 20;      ///< β [-], at least 0, of the grad-div term's far part (dilation.h)
};

/// One element's contributions to the linear system. Unknowns: tensor_basis.h.
struct ElementSystem {
  double energy = 0;  ///< [mJ * 1e-3 = mN mm]; infinite where J ≤ 0 at a point
  double min_J = 1, max_J = 1;
  double squared_flow = 0;     ///< |residual|² before assembly: the scale of "out of balance"
  double deformed_volume = 0;  ///< [mm³]
  Eigen::Matrix<double, kUnknowns, 1> residual;
  Eigen::MatrixXd tangent{kUnknowns, kUnknowns};  ///< lower triangle
  Eigen::Matrix<double, 8, 1> pressure_residual;
  Eigen::Matrix<double, kUnknowns, 8> coupling;  ///< ∂residual/∂p
};

/// Derivatives of one element's residuals by its reference shape X, at fixed x: rows as in
/// ElementSystem, columns the unknowns of X.
struct ReferenceSystem {
  Eigen::MatrixXd tangent{kUnknowns, kUnknowns};         ///< ∂residual/∂X, not symmetric
  Eigen::Matrix<double, 8, kUnknowns> pressure_tangent;  ///< ∂pressure_residual/∂X
  Eigen::Matrix<double, kUnknowns, 8> coupling;          ///< ∂residual/∂p
};

/// Mixed displacement-pressure element on a tri-cubic Hermite hexahedron:
///
///     Π(x, p) = ∫ W(F) + p (J − 1) − p²/(2κ) + U(J)  dV
///
/// stationary in x and p (design, section 3). The last term is the grad-div stabilisation: γ/2 (J −
/// 1)² near J = 1, growing without bound towards J = 0; it vanishes at the exact solution. 4 x 4 x
/// 4 Gauss points, tissue at each.
class SolidElement {
 public:
  using Coefficients = Eigen::Matrix<double, kFunctions, 3>;
  using Materials = std::array<std::shared_ptr<const Material>, kPoints>;

  /// X: the reference shape. Throws std::invalid_argument where det ∂X/∂ξ ≤ 0 at a Gauss point.
  explicit SolidElement(const Coefficients& X);

  /// Tissue at the Gauss points.
  void set_materials(const Materials& materials, const SolidOptions& options);

  int num_pressures() const { return num_pressures_; }
  double volume() const;                                    ///< of the reference shape [mm³]
  double point_weight(int q) const { return weights_[q]; }  ///< reference volume of a point [mm³]
  Eigen::Vector3d point_position(int q) const { return positions_.row(q); }  ///< X [mm]

  /// Fills `system` at deformed shape x and pressures p; tangent and coupling only if asked.
  void evaluate(const Coefficients& x, const double* p, TangentKind kind,
                ElementSystem& system) const;

  /// Fills `system` for the element under a constant force per reference volume [mN/mm³].
  void evaluate_reference(const Coefficients& x, const double* p, const Eigen::Vector3d& body_force,
                          ReferenceSystem& system) const;

  /// ∫ψψᵀ/κ, whose inverse eliminates the pressures.
  Eigen::MatrixXd pressure_compliance() const;

  /// ∫ φₐ f dV for a field f of the reference position: the load of a body force.
  Coefficients integrate(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& f) const;

  /// μ-weighted scalar Laplacian ∫ μ ∇φₐ·∇φ_b dV, the metric of a regularised step.
  Eigen::Matrix<double, kFunctions, kFunctions> laplacian() const;

  /// F at the Gauss points, for fields and figures.
  std::array<Eigen::Matrix3d, kPoints> deformation_gradients(const Coefficients& x) const;

  /// Pressure at the Gauss points: p plus the grad-div part γ/2 (J − 1/J) [kPa].
  std::array<double, kPoints> pressures(const Coefficients& x, const double* p) const;
  const Material& material(int q) const { return *materials_[q]; }

 private:
  Eigen::Matrix<double, kPoints, 3> positions_;
  std::array<Eigen::Matrix3d, kPoints> inverse_jacobians_;  ///< ∂ξ/∂X
  std::array<double, kPoints> weights_;
  Materials materials_;
  std::array<double, kPoints> bulk_, grad_div_;  ///< κ, γ [kPa]
  double quartic_ = 0;                           ///< β
  Eigen::Matrix<double, kPoints, 8> pressure_functions_;
  int num_pressures_ = 0;
};

}  // namespace mammotwin
