// How an element's residuals change with its reference shape, for unloading.
//
// Per unit of ξ, with g = ∂x/∂ξ fixed, H = ∂X/∂ξ, F = g H⁻¹ and b the body force:
//   residual           Q ∂φ/∂ξ − b φ det H,   Q = P cof H
//   pressure residual  ψ (det g − (1 + p/κ) det H)
// Differentiated by H: ∂F = −F ∂H H⁻¹, ∂det H = cof H : ∂H.

#include <Eigen/LU>

#include "solver/element/dilation.h"
#include "solver/element/face.h"
#include "solver/element/solid_element.h"
#include "solver/element/tensor_kernels.h"
#include "solver/material/kinematics.h"

namespace mammotwin {

namespace {

using Coefficients = SolidElement::Coefficients;
using Functions = Eigen::Matrix<double, kFunctions, 1>;

/// The fields of one element at the Gauss points, in the layout of the kernels.
struct ReferenceFields {
  double tangent[9][9 * kPoints];                 ///< [3 i + k][64 (3 J + L) + q]: ∂Q_iJ/∂H_kL
  double volume_flux[3][3 * kPoints];             ///< [i][64 J + q]: (cof F)_ij (cof H)_jJ
  double volume_tangent[3][3 * kPoints];          ///< [k][64 L + q]: (cof H)_kL
  Eigen::Matrix<double, kPoints, 1> compression;  ///< 1 + p/κ
  Eigen::Matrix<double, kFunctions, kPoints> functions;
};

struct PointKinematics {
  Eigen::Matrix3d F, G;  ///< F and H⁻¹
  double weight;         ///< reference weight times det H: the point's reference volume [mm³]
};

Functions functions_at(int q) {
  const auto& t = hermite_table().value;
  Functions f;
  for (int a = 0; a < kFunctions; ++a)
    f[a] = t[q & 3][a & 3] * t[q >> 2 & 3][a >> 2 & 3] * t[q >> 4][a >> 4];
  return f;
}

/// Column J: ∂φₐ/∂ξ_J.
Eigen::Matrix<double, kFunctions, 3> gradients_at(int q) {
  const auto& value = hermite_table().value;
  const auto& slope = hermite_table().slope;
  const int at[3] = {q & 3, q >> 2 & 3, q >> 4};
  Eigen::Matrix<double, kFunctions, 3> gradients;
  for (int a = 0; a < kFunctions; ++a)
    for (int J = 0; J < 3; ++J) {
      double product = 1;
      for (int d = 0; d < 3; ++d) product *= (d == J ? slope : value)[at[d]][a >> (2 * d) & 3];
      gradients(a, J) = product;
    }
  return gradients;
}

/// weight ∂(P cof H)_iJ/∂H_kL / det H, by the product rule; A = ∂P/∂F.
void store_tangent(const PointKinematics& point, const Eigen::Matrix3d& P,
                   const Material::Tangent& A, int q, double (&tangent)[9][9 * kPoints]) {
  const auto& [F, G, weight] = point;
  const Eigen::Matrix3d Q = P * G.transpose();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      Eigen::Matrix3d M = Eigen::Matrix3d::Zero();  // ∂P_ij/∂F_mn F_mk
      for (int j = 0; j < 3; ++j)
        for (int n = 0; n < 3; ++n)
          for (int m = 0; m < 3; ++m) M(j, n) += A(i + 3 * j, m + 3 * n) * F(m, k);
      const Eigen::Matrix3d c = weight * (Q.row(i).transpose() * G.col(k).transpose() -
                                          G.col(k) * Q.row(i) - G * M * G.transpose());
      for (int J = 0; J < 3; ++J)
        for (int L = 0; L < 3; ++L) tangent[3 * i + k][kPoints * (3 * J + L) + q] = c(J, L);
    }
}

void store_flux(const Eigen::Matrix3d& f, int q, double (&flux)[3][3 * kPoints]) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) flux[i][kPoints * J + q] = f(i, J);
}

void assemble_tangent(const ReferenceFields& fields, ReferenceSystem& system) {
  Eigen::Matrix<double, kFunctions, kFunctions> block;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      tangent_block(fields.tangent[3 * i + k], block.data());
      system.tangent.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * k) = block;
    }
}

/// −b ∫ φₐ cof H : ∂H, a load that grows with the reference volume.
void subtract_load(const ReferenceFields& fields, const Eigen::Vector3d& body_force,
                   ReferenceSystem& system) {
  if (body_force.isZero(0)) return;
  for (int k = 0; k < 3; ++k) {
    Eigen::Matrix<double, kPoints, kFunctions> change;  // of a point's volume, per unknown of X_k
    for (int q = 0; q < kPoints; ++q) {
      const double* flux = fields.volume_tangent[k];
      const Eigen::Vector3d at_point(flux[q], flux[kPoints + q], flux[2 * kPoints + q]);
      change.row(q) = (gradients_at(q) * at_point).transpose();
    }
    const Eigen::Matrix<double, kFunctions, kFunctions> load = fields.functions * change;
    for (int i = 0; i < 3; ++i)
      system.tangent.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * k) -=
          body_force[i] * load;
  }
}

void assemble_pressures(const ReferenceFields& fields, const Eigen::Matrix<double, kPoints, 8>& psi,
                        int num_pressures, ReferenceSystem& system) {
  using Flux = Eigen::Array<double, kPoints, 3>;
  system.coupling.setZero();
  system.pressure_tangent.setZero();
  for (int m = 0; m < num_pressures; ++m)
    for (int i = 0; i < 3; ++i) {
      const Flux force =
          Eigen::Map<const Flux>(fields.volume_flux[i]).colwise() * psi.col(m).array();
      add_gradient_transposed(force.data(), system.coupling.col(m).data() + kFunctions * i);
      const Flux volume = Eigen::Map<const Flux>(fields.volume_tangent[i]).colwise() *
                          (psi.col(m).cwiseProduct(fields.compression)).array();
      Functions sum = Functions::Zero();
      add_gradient_transposed(volume.data(), sum.data());
      system.pressure_tangent.block<1, kFunctions>(m, kFunctions * i) = -sum.transpose();
    }
}

}  // namespace

void SolidElement::evaluate_reference(const Coefficients& x, const double* p,
                                      const Eigen::Vector3d& body_force,
                                      ReferenceSystem& system) const {
  static thread_local ReferenceFields fields;
  const auto F = deformation_gradients(x);
  const Eigen::Map<const Eigen::VectorXd> pressures(p, num_pressures_);
  for (int q = 0; q < kPoints; ++q) {
    const PointKinematics point{F[q], inverse_jacobians_[q], weights_[q]};
    const Eigen::Matrix3d cof = cofactor(point.F);
    const double pressure = pressure_functions_.row(q).head(num_pressures_).dot(pressures);
    const Dilation U = dilation(grad_div_[q], quartic_, point.F.determinant());
    const double total = pressure + U.slope;
    Material::Tangent A = materials_[q]->tangent(point.F);
    A += U.curvature * cof.reshaped() * cof.reshaped().transpose();
    add_cofactor_tangent(total, point.F, A);
    store_tangent(point, materials_[q]->stress(point.F) + total * cof, A, q, fields.tangent);
    store_flux(point.weight * cof * point.G.transpose(), q, fields.volume_flux);
    store_flux(point.weight * point.G.transpose(), q, fields.volume_tangent);
    fields.compression[q] = 1 + pressure / bulk_[q];
    fields.functions.col(q) = functions_at(q);
  }
  assemble_tangent(fields, system);
  subtract_load(fields, body_force, system);
  assemble_pressures(fields, pressure_functions_, num_pressures_, system);
}

}  // namespace mammotwin
