#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace mammotwin {

/// Which second derivatives of an energy are wanted: none, all, or those of its convex part. The
/// tangent of convex parts is positive semidefinite whatever the state, and the exact one wherever
/// every point's is (Teran et al., Robust quasistatic finite elements and flesh simulation,
/// Symposium on Computer Animation 2005).
enum class TangentKind { none, exact, convex };

/// The nearest positive semidefinite matrix to a symmetric one: negative eigenvalues become 0.
template <int N>
Eigen::Matrix<double, N, N> convex_part(const Eigen::Matrix<double, N, N>& matrix) {
  using Matrix = Eigen::Matrix<double, N, N>;
  if (Eigen::LLT<Matrix>(matrix).info() == Eigen::Success) return matrix;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// The same of a tangent ∂P/∂F (as Material::Tangent has it) of an isotropic law at F, in less
/// work: in the axes of F's singular vectors it is three 2x2 blocks and one of 3x3 (Smith, de Goes,
/// Kim, Analytic eigensystems for isotropic distortion energies, ACM Transactions on Graphics 38,
/// 2019).
Eigen::Matrix<double, 9, 9> isotropic_convex_part(const Eigen::Matrix<double, 9, 9>& tangent,
                                                  const Eigen::Matrix3d& F);

}  // namespace mammotwin
