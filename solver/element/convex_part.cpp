#include "solver/element/convex_part.h"

#include <array>

namespace mammotwin {
namespace {

using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Vector9d = Eigen::Matrix<double, 9, 1>;

/// Adds what makes the block of `tangent` in these directions positive semidefinite to `result`;
/// `curved`: the tangent times the directions.
template <int N>
void lift_block(const Eigen::Matrix<double, 9, N>& directions,
                const Eigen::Matrix<double, 9, N>& curved, Matrix9d& result) {
  const Eigen::Matrix<double, N, N> block = directions.transpose() * curved;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen;
  if constexpr (N == 2)
    eigen.computeDirect(block);
  else
    eigen.compute(block);
  for (int i = 0; i < N && eigen.eigenvalues()[i] < 0; ++i) {
    const Vector9d mode = directions * eigen.eigenvectors().col(i);
    result -= eigen.eigenvalues()[i] * mode * mode.transpose();
  }
}

}  // namespace

Matrix9d isotropic_convex_part(const Matrix9d& tangent, const Eigen::Matrix3d& F) {
  if (Eigen::LLT<Matrix9d>(tangent).info() == Eigen::Success) return tangent;
  const Eigen::Matrix3d V =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(F.transpose() * F).eigenvectors();
  const Eigen::Matrix3d U = (F * V).colwise().normalized();
  Matrix9d modes;  // u_i v_jᵀ, unrolled column by column
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) modes.col(i + 3 * j) = (U.col(i) * V.col(j).transpose()).reshaped();
  const Matrix9d curved = tangent * modes;
  Matrix9d result = tangent;
  const std::array<int, 3> stretches{0, 4, 8};
  lift_block<3>(modes(Eigen::all, stretches), curved(Eigen::all, stretches), result);
  for (const auto& pair : {std::array{1, 3}, std::array{2, 6}, std::array{5, 7}})
    lift_block<2>(modes(Eigen::all, pair), curved(Eigen::all, pair), result);
  return result;
}

}  // namespace mammotwin
