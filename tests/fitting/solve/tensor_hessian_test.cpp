#include "fitting/solve/tensor_hessian.h"

#include <gtest/gtest.h>

#include <random>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {
namespace {

using Tensor = Eigen::Matrix<double, 9, 9>;  // between entries c + 3 i and b + 3 j of ∂x/∂ξ

/// ∂x/∂ξ at a point by the element's parameters.
Eigen::MatrixXd gradient(const Eigen::Vector3d& xi, const Eigen::Vector3d& lengths) {
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(9, 192);
  for (int i = 0; i < 3; ++i) {
    std::array<int, 3> orders = {0, 0, 0};
    orders[i] = 1;
    const HermiteMesh::Weights w = HermiteMesh::weights(xi, orders);
    for (int p = 0; p < 64; ++p)
      for (int c = 0; c < 3; ++c) g(c + 3 * i, 3 * p + c) = w(p / 8, p % 8) / lengths[i];
  }
  return g;
}

TEST(TensorHessian, IsTheSumOverPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Eigen::Vector3d lengths(2, 3, 0.7);
  for (const std::vector<double>& points : {std::vector{0.0, 0.3, 1.0}, std::vector{0.1, 0.8}}) {
    const TensorHessian grid(points, lengths);
    std::vector<double> tensors(grid.num_entries());
    Eigen::MatrixXd expected = Eigen::MatrixXd::Ones(192, 192);
    for (int q = 0; q < grid.num_points(); ++q) {
      Tensor t = Tensor::NullaryExpr([&] { return uniform(random); });
      t = (t + t.transpose()).eval();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int c = 0; c < 3; ++c)
            for (int b = 0; b <= c; ++b)
              tensors[grid.place(i, j, q) + TensorHessian::pair(c, b)] = t(c + 3 * i, b + 3 * j);
      const Eigen::MatrixXd g = gradient(grid.point(q), lengths);
      expected += g.transpose() * t * g;
    }
    Eigen::MatrixXd sum = Eigen::MatrixXd::Ones(192, 192);
    grid.add(tensors, sum);
    // Sums of up to 27 x 9 x 9 terms of order 10: rounding stays below 1e-12 of the largest.
    EXPECT_LT((sum - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  }
}

}  // namespace
}  // namespace mammotwin
