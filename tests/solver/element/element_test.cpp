#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "solver/element/dilation.h"
#include "solver/element/face.h"
#include "solver/element/gauss.h"
#include "solver/element/skin_membrane.h"
#include "solver/element/tensor_kernels.h"
#include "solver/material/mooney_rivlin.h"
#include "tests/solver/test_meshes.h"
#include "tests/verification/follower_pressure.h"

namespace mammotwin {
namespace {

using Coefficients = SolidElement::Coefficients;

/// A distorted element of about 10 mm, and a deformed shape of it.
struct OneElement {
  HermiteMesh mesh = distorted(box_mesh({10, 12, 9}, {1, 1, 1}), 0.4, 1);
  Model model;
  State state;
  explicit OneElement(PressureSpace space = PressureSpace::trilinear)
      : model(mesh, uniform(std::make_shared<MooneyRivlin>(0.8, 0.2)), {space, 50, 5}) {
    state = model.rest();
    state.x = distorted(mesh, 0.5, 2).nodes();
    for (int m = 0; m < 8; ++m) state.pressure[m] = 0.3 - 0.1 * m;
  }
};

/// Of the tangent, whose upper triangle nobody fills.
double largest_entry(const ElementSystem& system) {
  return system.tangent.triangularView<Eigen::Lower>().toDenseMatrix().cwiseAbs().maxCoeff();
}

double& unknown(State& state, const HermiteMesh& mesh, int k) {
  const int a = k % kFunctions;
  return state.x[mesh.corners(0)[corner_of_function(a)]](k / kFunctions, parameter_of_function(a));
}

/// Residual and tangent against central differences of energy and residual, all components. The
/// residual's own size is about 100 mN; differences at h = 1e-5 mm are good to 1e-7 of that.
void expect_consistent(OneElement& one) {
  constexpr double h = 1e-5;
  ElementSystem exact, plus, minus;
  one.model.evaluate(0, one.state, TangentKind::exact, exact);
  const double scale = largest_entry(exact);
  for (int k = 0; k < kUnknowns; ++k) {
    double& x = unknown(one.state, one.mesh, k);
    const double kept = x;
    x = kept + h;
    one.model.evaluate(0, one.state, TangentKind::none, plus);
    x = kept - h;
    one.model.evaluate(0, one.state, TangentKind::none, minus);
    x = kept;
    EXPECT_NEAR((plus.energy - minus.energy) / (2 * h), exact.residual[k], 1e-6 * scale) << k;
    const auto difference = ((plus.residual - minus.residual) / (2 * h)).eval();
    for (int r = k; r < kUnknowns; ++r)
      EXPECT_NEAR(difference[r], exact.tangent(r, k), 1e-7 * scale) << r << "," << k;
    const auto volume = ((plus.pressure_residual - minus.pressure_residual) / (2 * h)).eval();
    const int n = one.model.element(0).num_pressures();
    EXPECT_NEAR((volume.head(n) - exact.coupling.row(k).head(n).transpose()).norm(), 0,
                1e-6 * scale);
  }
}

TEST(Gauss, IntegratesPolynomialsExactly) {
  const auto rule = gauss_rule(4);
  for (int degree = 0; degree <= 7; ++degree) {
    double sum = 0;
    for (int q = 0; q < 4; ++q) sum += rule.weights[q] * std::pow(rule.points[q], degree);
    EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-14) << degree;
  }
}

TEST(TensorKernels, GradientIsTheMeshsJacobian) {
  const OneElement one;
  const Coefficients x = one.model.coefficients(one.state.x, 0);
  double gradient[3 * kPoints];
  const auto& t = hermite_table().points;
  const HermiteMesh deformed(one.state.x, one.mesh.elements());
  for (int i = 0; i < 3; ++i) {
    gradient_at_points(x.col(i).data(), gradient);
    for (int q = 0; q < kPoints; ++q) {
      const auto expected = deformed.jacobian({0, {t[q & 3], t[q >> 2 & 3], t[q >> 4]}});
      for (int J = 0; J < 3; ++J) EXPECT_NEAR(gradient[64 * J + q], expected(i, J), 1e-12);
    }
  }
}

TEST(SolidElement, ResidualAndTangentAreDerivatives) {
  for (auto space : {PressureSpace::constant, PressureSpace::linear, PressureSpace::trilinear}) {
    OneElement one(space);
    expect_consistent(one);
  }
}

double smallest_eigenvalue(const ElementSystem& system) {
  const Eigen::MatrixXd full = system.tangent.selfadjointView<Eigen::Lower>();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full, Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

// Pressures of 25 times the shear modulus, as iterates far from balance have them.
TEST(SolidElement, ConvexTangentIsSemidefiniteWhereTheExactOneIsNot) {
  OneElement one;
  for (int m = 0; m < 8; ++m) one.state.pressure[m] *= 160;
  ElementSystem exact, convex;
  one.model.evaluate(0, one.state, TangentKind::exact, exact);
  one.model.evaluate(0, one.state, TangentKind::convex, convex);
  const double scale = largest_entry(exact);
  EXPECT_LT(smallest_eigenvalue(exact), -1e-3 * scale);
  EXPECT_GT(smallest_eigenvalue(convex), -1e-12 * scale);
  EXPECT_EQ(convex.residual, exact.residual);
}

TEST(SolidElement, ConvexTangentIsTheExactOneAtRest) {
  OneElement one;
  one.state = one.model.rest();
  ElementSystem exact, convex;
  one.model.evaluate(0, one.state, TangentKind::exact, exact);
  one.model.evaluate(0, one.state, TangentKind::convex, convex);
  const double scale = largest_entry(exact);
  const Eigen::MatrixXd change = exact.tangent - convex.tangent;
  EXPECT_LT(change.triangularView<Eigen::Lower>().toDenseMatrix().cwiseAbs().maxCoeff(),
            1e-12 * scale);
}

// U'' and U' of the stabilisation by central differences, each better than 1e-8 of its size; the
// quartic part alone is what is more than without it.
TEST(Dilation, SlopeAndCurvatureAreDerivatives) {
  constexpr double h = 1e-5;
  for (const double beta : {0.0, 20.0})
    for (const double J : {0.4, 0.8, 1.0, 1.05, 1.7}) {
      const Dilation U = dilation(3, beta, J), up = dilation(3, beta, J + h),
                     down = dilation(3, beta, J - h);
      EXPECT_NEAR(U.slope, (up.energy - down.energy) / (2 * h), 1e-6 * U.curvature);
      EXPECT_NEAR(U.curvature, (up.slope - down.slope) / (2 * h), 1e-6 * U.curvature);
      const double d = (J - 1 / J) / 2;
      EXPECT_NEAR(U.energy - dilation(3, 0, J).energy, 3 * beta / 4 * std::pow(d, 4), 1e-12);
    }
}

TEST(SolidElement, PressureResidualIsDerivativeOfEnergy) {
  OneElement one;
  ElementSystem exact, plus, minus;
  one.model.evaluate(0, one.state, TangentKind::none, exact);
  for (int m = 0; m < 8; ++m) {  // the energy is quadratic in p: differences are exact to rounding
    State other = one.state;
    other.pressure[m] += 0.5;
    one.model.evaluate(0, other, TangentKind::none, plus);
    other.pressure[m] -= 1;
    one.model.evaluate(0, other, TangentKind::none, minus);
    EXPECT_NEAR(plus.energy - minus.energy, exact.pressure_residual[m], 1e-9);
  }
}

TEST(SolidElement, VolumeOfADistortedElementIsItsFacesFlux) {
  // Divergence theorem: V = ∮ X·N/3 dA; both rules integrate these polynomials of degree 8 along
  // each direction only to their own order, so a mild distortion leaves about 1e-6.
  const OneElement one;
  double flux = 0;
  for (int face = 0; face < 6; ++face) {
    const Face f(0, face, one.model.coefficients(one.mesh.nodes(), 0), 5);
    for (int q = 0; q < f.num_points(); ++q)
      flux += f.point(q).X.dot(f.point(q).normal) * f.point(q).area / 3;
  }
  EXPECT_NEAR(flux, one.model.volume(), 1e-6 * one.model.volume());
}

TEST(SolidElement, RefusesAFoldedMesh) {
  auto nodes = box_mesh({10, 10, 10}, {1, 1, 1}).nodes();
  std::swap(nodes[0], nodes[1]);
  const HermiteMesh folded(nodes, {HermiteMesh::Corners{0, 1, 2, 3, 4, 5, 6, 7}});
  EXPECT_THROW(Model(folded, uniform(std::make_shared<MooneyRivlin>(1, 0)), {}),
               std::invalid_argument);
}

TEST(SkinMembrane, ResidualAndTangentAreDerivatives) {
  for (const double stiffening : {0.0, 2.0})
    for (int face = 0; face < 6; ++face) {
      OneElement one;
      one.model.add_surface_potential(0, face,
                                      std::make_shared<SkinMembrane>(3.3, 1.5, stiffening));
      expect_consistent(one);
    }
}

TEST(FollowerPressure, ResidualAndTangentAreDerivatives) {
  for (int face = 0; face < 6; ++face) {
    OneElement one;
    auto pressure = std::make_shared<FollowerPressure>();
    pressure->pressure = 2;
    pressure->axis = Eigen::Vector3d(0.6, 0, 0.8);
    one.model.add_surface_potential(0, face, pressure);
    expect_consistent(one);
  }
}

// A flat membrane stretched by λ in both directions thins by λ⁻²: energy h c₁ (2λ² + λ⁻⁴ − 3) per
// reference area.
TEST(SkinMembrane, EnergyOfEquibiaxialStretch) {
  const SkinMembrane skin(3.3, 1.5);
  const SurfacePoint point{{}, {10, 0, 0}, {0, 8, 0}, {0, 0, 1}, 80};
  Eigen::Matrix<double, 9, 1> y;
  const double stretch = 1.3;
  y << 0, 0, 0, 0, stretch * 10, 0, 0, 0, stretch * 8;  // turned out of its plane as well
  SurfaceResponse response;
  skin.respond(y, point, 0, response);
  const double strain = 2 * stretch * stretch + std::pow(stretch, -4) - 3;
  EXPECT_NEAR(response.energy, 1.5 * 3.3 * strain, 1e-12);
  SkinMembrane(3.3, 1.5, 2).respond(y, point, 0, response);
  EXPECT_NEAR(response.energy, 1.5 * 3.3 / 2 * (std::exp(2 * strain) - 1), 1e-12);
  EXPECT_THROW(SkinMembrane(3.3, 1.5, -1), std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
