#include "fitting/mesh/hermite_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "fitting/mesh/hermite_basis.h"
#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

// Rounding of sums of 64 products of numbers up to 40 mm: 64 * 40 * 1e-16 < 1e-12.
constexpr double rounding = 1e-12;

const std::vector<Vector3d> places = {{0, 0, 0},       {1, 1, 1},       {0.5, 0.5, 0.5},
                                      {0.1, 0.7, 0.3}, {0.9, 0.2, 0.6}, {1, 0, 0.4}};

/// Σ cᵢⱼₖ xⁱ yʲ zᵏ, i, j, k to 3, and its derivatives by the power rule.
struct TriCubic {
  double coefficient(int i, int j, int k) const { return std::sin(1 + i + 4 * j + 16 * k); }
  static double power(double t, int n, int order) {
    double factor = 1;
    for (int m = 0; m < order; ++m) factor *= n - m;
    return n < order ? 0 : factor * std::pow(t, n - order);
  }
  double operator()(const Vector3d& x, int dx, int dy, int dz) const {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k)
          sum +=
              coefficient(i, j, k) * power(x[0], i, dx) * power(x[1], j, dy) * power(x[2], k, dz);
    return sum;
  }
};

TEST(HermiteBasis, DerivativesMatchDifferences) {
  // Central differences of a cubic err by h² |p'''| / 6 <= 2e-10 plus rounding 1e-16/h = 1e-11.
  const double h = 1e-5;
  for (double t : {0.0, 0.2, 0.5, 0.93, 1.0})
    for (int order : {1, 2}) {
      const auto exact = hermite_derivatives(t, order);
      const auto up = hermite_derivatives(t + h, order - 1);
      const auto down = hermite_derivatives(t - h, order - 1);
      for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(exact[i], (up[i] - down[i]) / (2 * h), 1e-9) << "t " << t << " order " << order;
    }
}

TEST(HermiteMesh, ValueWeightsSumToOneAndTheirDerivativesToZero) {
  for (const Vector3d& xi : places) {
    EXPECT_NEAR(HermiteMesh::weights(xi).col(0).sum(), 1, rounding);
    for (int i = 0; i < 3; ++i) {
      std::array<int, 3> orders{0, 0, 0};
      orders[i] = 1;
      EXPECT_NEAR(HermiteMesh::weights(xi, orders).col(0).sum(), 0, rounding);
    }
  }
}

TEST(HermiteMesh, EachParameterIsTheDerivativeItNames) {
  for (int corner = 0; corner < 8; ++corner)
    for (int d = 0; d < 8; ++d) {
      const Vector3d xi(corner & 1, corner >> 1 & 1, corner >> 2);
      HermiteMesh::Weights expected = HermiteMesh::Weights::Zero();
      expected(corner, d) = 1;
      const auto found = HermiteMesh::weights(xi, {d & 1, d >> 1 & 1, d >> 2});
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), rounding);
    }
}

TEST(HermiteMesh, ReproducesTriCubicPolynomials) {
  const TriCubic p;
  const HermiteMesh box = block_mesh(Vector3d(-1, 0, -2), Vector3d(1, 3, 2), {2, 3, 2});
  const Vector3d size(1, 1, 2);
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  for (auto& node : nodes) {
    const Vector3d x = node.col(0);
    for (int d = 0; d < 8; ++d) {
      const int dx = d & 1, dy = d >> 1 & 1, dz = d >> 2;
      node(0, d) =
          p(x, dx, dy, dz) * std::pow(size[0], dx) * std::pow(size[1], dy) * std::pow(size[2], dz);
    }
  }
  const HermiteMesh mesh(nodes, box.elements());
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (const Vector3d& xi : places) {
      const Vector3d x = box.position({e, xi});
      // Values reach 1e3 here, so rounding of the sums stays below 1e-11.
      EXPECT_NEAR(mesh.position({e, xi}).x(), p(x, 0, 0, 0), 1e-10);
      EXPECT_NEAR(mesh.jacobian({e, xi})(0, 2), p(x, 0, 0, 1) * size[2], 1e-10);
    }
}

TEST(HermiteMesh, JacobianMatchesDifferences) {
  const HermiteMesh mesh = distorted_mesh({2, 2, 2}, 2);
  // h² |x'''| / 6 with third derivatives up to about 500 mm is 1e-8 at h = 1e-5.
  const double h = 1e-5;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (const Vector3d& xi : places)
      for (int i = 0; i < 3; ++i) {
        const Vector3d step = h * Vector3d::Unit(i);
        const Vector3d difference =
            (mesh.position({e, xi + step}) - mesh.position({e, xi - step})) / (2 * h);
        EXPECT_LT((mesh.jacobian({e, xi}).col(i) - difference).norm(), 1e-7);
      }
}

TEST(HermiteMesh, PositionAndJacobianAreContinuousAcrossSharedFaces) {
  const HermiteMesh mesh = distorted_mesh({2, 2, 2}, 2);
  for (int axis = 0; axis < 3; ++axis) {
    const int neighbour = 1 << axis;  // of element 0 in a 2 x 2 x 2 grid
    for (Vector3d xi : places) {
      Vector3d other = xi;
      xi[axis] = 1;
      other[axis] = 0;
      EXPECT_LT((mesh.position({0, xi}) - mesh.position({neighbour, other})).norm(), rounding);
      EXPECT_LT((mesh.jacobian({0, xi}) - mesh.jacobian({neighbour, other})).norm(), rounding);
    }
  }
}

TEST(HermiteMesh, RefusesCornersThatAreNotNodes) {
  const HermiteMesh box = block_mesh(Vector3d::Zero(), Vector3d::Ones(), {1, 1, 1});
  auto elements = box.elements();
  elements[0][5] = 8;
  EXPECT_THROW(HermiteMesh(box.nodes(), elements), std::invalid_argument);
}

TEST(BlockMesh, HasTheSizeAskedAndAConstantJacobian) {
  const HermiteMesh box = block_mesh(Vector3d(1, 2, 3), Vector3d(5, 8, 6), {2, 3, 1});
  EXPECT_EQ(box.num_elements(), 6);
  EXPECT_EQ(box.num_nodes(), 24);
  for (const Vector3d& xi : places)
    EXPECT_LT((box.jacobian({4, xi}) - Vector3d(2, 2, 3).asDiagonal().toDenseMatrix()).norm(),
              rounding);
  EXPECT_LT((box.position({5, Vector3d::Ones()}) - Vector3d(5, 8, 6)).norm(), rounding);
}

}  // namespace
}  // namespace mammotwin
