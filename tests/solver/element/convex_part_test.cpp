#include "solver/element/convex_part.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

using Matrix = Eigen::Matrix3d;

TEST(ConvexPart, LeavesAPositiveDefiniteMatrixAsItIs) {
  Matrix m;
  m << 4, 1, 0, 1, 3, -1, 0, -1, 2;
  EXPECT_EQ(convex_part<3>(m), m);
}

// Eigenvalues 3 and -1 along (1, 1) and (1, -1), and 2: without the negative one 1.5 everywhere.
TEST(ConvexPart, TakesNegativeEigenvaluesOut) {
  Matrix m, expected;
  m << 1, 2, 0, 2, 1, 0, 0, 0, 2;
  expected << 1.5, 1.5, 0, 1.5, 1.5, 0, 0, 0, 2;
  EXPECT_LT((convex_part<3>(m) - expected).norm(), 1e-14);
}

TEST(ConvexPart, OfANegativeDefiniteMatrixIsNothing) {
  EXPECT_LT(convex_part<3>(-Matrix::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace mammotwin
