#include "solver/element/solid_element.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/dilation.h"
#include "solver/element/tensor_kernels.h"
#include "solver/material/kinematics.h"

namespace mammotwin {

namespace {

using Tangent = Material::Tangent;
using PointGradients = Eigen::Matrix<double, 3 * kPoints, 3>;  ///< row 64 J + q, column i

PointGradients point_gradients(const SolidElement::Coefficients& x) {
  PointGradients g;
  for (int i = 0; i < 3; ++i) gradient_at_points(x.col(i).data(), g.col(i).data());
  return g;
}

/// ∂x/∂ξ at point q, column J the derivative along ξ_J.
Eigen::Matrix3d jacobian_at(const PointGradients& g, int q) {
  Eigen::Matrix3d j;
  for (int J = 0; J < 3; ++J) j.col(J) = g.row(kPoints * J + q);
  return j;
}

Eigen::Matrix<double, kFunctions, 1> functions_at(const std::array<double, 3>& xi) {
  const auto h1 = hermite_values(xi[0]), h2 = hermite_values(xi[1]), h3 = hermite_values(xi[2]);
  Eigen::Matrix<double, kFunctions, 1> f;
  for (int a = 0; a < kFunctions; ++a) f[a] = h1[a & 3] * h2[a >> 2 & 3] * h3[a >> 4];
  return f;
}

std::array<double, 3> point_xi(int q) {
  const auto& t = hermite_table().points;
  return {t[q & 3], t[q >> 2 & 3], t[q >> 4]};
}

double reference_weight(int q) {
  const auto& w = hermite_table().weights;
  return w[q & 3] * w[q >> 2 & 3] * w[q >> 4];
}

/// Legendre products 1, ξ₁, ξ₂, ξ₃, ξ₁ξ₂, ξ₁ξ₃, ξ₂ξ₃, ξ₁ξ₂ξ₃ (orthonormal on the unit cube), so the
/// first 1, 4 and 8 are the three spaces.
Eigen::Matrix<double, kPoints, 8> legendre_products() {
  constexpr int exponents[8] = {0, 1, 2, 4, 3, 5, 6, 7};
  Eigen::Matrix<double, kPoints, 8> psi;
  for (int q = 0; q < kPoints; ++q)
    for (int m = 0; m < 8; ++m) {
      psi(q, m) = 1;
      for (int i = 0; i < 3; ++i)
        if (exponents[m] >> i & 1) psi(q, m) *= std::sqrt(3.0) * (2 * point_xi(q)[i] - 1);
    }
  return psi;
}

/// The fields of one evaluation at the Gauss points, in the layout of the kernels.
struct PointFields {
  double flux[3][3 * kPoints];         ///< [i][64 J + q]: w P_ij ∂ξ_J/∂X_j
  double volume_flux[3][3 * kPoints];  ///< the same with cof F for P
  double tangent[6][9 * kPoints];      ///< [component pair][64 (3 J + L) + q]
};

/// Pairs of components (row, column) of the tangent's lower blocks.
constexpr int kPairs[6][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {2, 1}, {2, 2}};

void store_flux(const Eigen::Matrix3d& P, const Eigen::Matrix3d& G, int q, double w,
                double (&flux)[3][3 * kPoints]) {
  const Eigen::Matrix3d f = w * P * G.transpose();
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) flux[i][kPoints * J + q] = f(i, J);
}

void store_tangent(const Tangent& A, const Eigen::Matrix3d& G, int q, double w,
                   double (&tangent)[6][9 * kPoints]) {
  for (int pair = 0; pair < 6; ++pair) {
    Eigen::Matrix3d a;
    for (int l = 0; l < 3; ++l)
      for (int j = 0; j < 3; ++j) a(j, l) = A(kPairs[pair][0] + 3 * j, kPairs[pair][1] + 3 * l);
    const Eigen::Matrix3d c = w * G * a * G.transpose();
    for (int J = 0; J < 3; ++J)
      for (int L = 0; L < 3; ++L) tangent[pair][kPoints * (3 * J + L) + q] = c(J, L);
  }
}

void assemble_residual(const PointFields& fields, ElementSystem& system) {
  system.residual.setZero();
  for (int i = 0; i < 3; ++i)
    add_gradient_transposed(fields.flux[i], system.residual.data() + kFunctions * i);
}

void assemble_tangent(const PointFields& fields, ElementSystem& system) {
  Eigen::Matrix<double, kFunctions, kFunctions> block;
  for (int pair = 0; pair < 6; ++pair) {
    tangent_block(fields.tangent[pair], block.data());
    system.tangent.block<kFunctions, kFunctions>(kFunctions * kPairs[pair][0],
                                                 kFunctions * kPairs[pair][1]) = block;
  }
}

void assemble_coupling(const PointFields& fields, const Eigen::Matrix<double, kPoints, 8>& psi,
                       int num_pressures, ElementSystem& system) {
  system.coupling.setZero();
  Eigen::Array<double, kPoints, 3> flux;
  for (int m = 0; m < num_pressures; ++m)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Map<const Eigen::Array<double, kPoints, 3>> volume(fields.volume_flux[i]);
      flux = volume.colwise() * psi.col(m).array();
      add_gradient_transposed(flux.data(), system.coupling.col(m).data() + kFunctions * i);
    }
}

void mark_invalid(ElementSystem& system, double J) {
  system.energy = std::numeric_limits<double>::infinity();
  system.min_J = J;
}

}  // namespace

SolidElement::SolidElement(const Coefficients& X) {
  const PointGradients g = point_gradients(X);
  for (int q = 0; q < kPoints; ++q) {
    const Eigen::Matrix3d jacobian = jacobian_at(g, q);
    const double det = jacobian.determinant();
    if (!(det > 0))
      throw std::invalid_argument("det dX/dxi is " + std::to_string(det) +
                                  " mm^3 at a Gauss point; the mesh is folded");
    inverse_jacobians_[q] = jacobian.inverse();
    weights_[q] = reference_weight(q) * det;
    positions_.row(q) = functions_at(point_xi(q)).transpose() * X;
  }
}

void SolidElement::set_materials(const Materials& materials, const SolidOptions& options) {
  materials_ = materials;
  num_pressures_ = static_cast<int>(options.pressure);
  pressure_functions_ = legendre_products();
  quartic_ = options.quartic;
  for (int q = 0; q < kPoints; ++q) {
    const double mu = materials[q]->shear_modulus();
    bulk_[q] = options.bulk_ratio * mu;
    grad_div_[q] = options.grad_div * mu;
  }
}

double SolidElement::volume() const {
  double volume = 0;
  for (double w : weights_) volume += w;
  return volume;
}

void SolidElement::evaluate(const Coefficients& x, const double* p, TangentKind kind,
                            ElementSystem& system) const {
  static thread_local PointFields fields;
  const PointGradients g = point_gradients(x);
  const Eigen::Map<const Eigen::VectorXd> pressures(p, num_pressures_);
  system.energy = system.deformed_volume = 0;
  system.min_J = std::numeric_limits<double>::infinity();
  system.max_J = -system.min_J;
  system.pressure_residual.setZero();
  for (int q = 0; q < kPoints; ++q) {
    const Eigen::Matrix3d& G = inverse_jacobians_[q];
    const double w = weights_[q];
    const Eigen::Matrix3d F = jacobian_at(g, q) * G;
    const Eigen::Matrix3d cof = cofactor(F);
    const double J = F.col(0).dot(cof.col(0));
    if (!(J > 0)) return mark_invalid(system, J);
    const auto psi = pressure_functions_.row(q).head(num_pressures_);
    const double pressure = psi.dot(pressures);
    const Dilation U = dilation(grad_div_[q], quartic_, J);
    const double total = pressure + U.slope;
    system.energy += w * (materials_[q]->energy(F) + pressure * (J - 1) + U.energy -
                          pressure * pressure / (2 * bulk_[q]));
    system.deformed_volume += w * J;
    system.min_J = std::min(system.min_J, J);
    system.max_J = std::max(system.max_J, J);
    system.pressure_residual.head(num_pressures_) +=
        w * (J - 1 - pressure / bulk_[q]) * psi.transpose();
    store_flux(materials_[q]->stress(F) + total * cof, G, q, w, fields.flux);
    if (kind == TangentKind::none) continue;
    store_flux(cof, G, q, w, fields.volume_flux);
    Tangent A = materials_[q]->tangent(F);
    A += U.curvature * cof.reshaped() * cof.reshaped().transpose();
    add_cofactor_tangent(total, F, A);
    store_tangent(kind == TangentKind::convex ? isotropic_convex_part(A, F) : A, G, q, w,
                  fields.tangent);
  }
  assemble_residual(fields, system);
  system.squared_flow = system.residual.squaredNorm();
  if (kind == TangentKind::none) return;
  assemble_tangent(fields, system);
  assemble_coupling(fields, pressure_functions_, num_pressures_, system);
}

Eigen::MatrixXd SolidElement::pressure_compliance() const {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(num_pressures_, num_pressures_);
  for (int q = 0; q < kPoints; ++q) {
    const auto psi = pressure_functions_.row(q).head(num_pressures_);
    M += weights_[q] / bulk_[q] * psi.transpose() * psi;
  }
  return M;
}

SolidElement::Coefficients SolidElement::integrate(
    const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& f) const {
  Coefficients sum = Coefficients::Zero();
  for (int q = 0; q < kPoints; ++q)
    sum += weights_[q] * functions_at(point_xi(q)) * f(point_position(q)).transpose();
  return sum;
}

Eigen::Matrix<double, kFunctions, kFunctions> SolidElement::laplacian() const {
  double coefficients[9 * kPoints];
  for (int q = 0; q < kPoints; ++q) {
    const Eigen::Matrix3d& G = inverse_jacobians_[q];
    const Eigen::Matrix3d c = weights_[q] * materials_[q]->shear_modulus() * G * G.transpose();
    for (int J = 0; J < 3; ++J)
      for (int L = 0; L < 3; ++L) coefficients[kPoints * (3 * J + L) + q] = c(J, L);
  }
  Eigen::Matrix<double, kFunctions, kFunctions> block;
  tangent_block(coefficients, block.data());
  return block;
}

std::array<Eigen::Matrix3d, kPoints> SolidElement::deformation_gradients(
    const Coefficients& x) const {
  const PointGradients g = point_gradients(x);
  std::array<Eigen::Matrix3d, kPoints> F;
  for (int q = 0; q < kPoints; ++q) F[q] = jacobian_at(g, q) * inverse_jacobians_[q];
  return F;
}

std::array<double, kPoints> SolidElement::pressures(const Coefficients& x, const double* p) const {
  const auto F = deformation_gradients(x);
  std::array<double, kPoints> total;
  for (int q = 0; q < kPoints; ++q) {
    double pressure = 0;
    for (int m = 0; m < num_pressures_; ++m) pressure += pressure_functions_(q, m) * p[m];
    total[q] = pressure + dilation(grad_div_[q], quartic_, F[q].determinant()).slope;
  }
  return total;
}

}  // namespace mammotwin
