#include "solver/press/solution_fields.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

#include "solver/press/press.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

/// A dome of fat with its plates away from it, and a state of our own choice.
struct FatDome {
  CompressionProblem problem = [] {
    CompressionProblem p = dome_problem(60, false);
    p.mesh = dome_breast({3, 3, 2});
    return p;
  }();
  CompressionOptions options;
  Press press{problem, options};
  State state = press.model().rest();

  explicit FatDome(double support = -500, double paddle = 500) {
    press.put(press.frame().place(support, paddle, 0));
    press.set_penalty(2);
  }
  void deform(const Eigen::Matrix3d& A) {
    for (auto& node : state.x) node = (A * node).eval();
  }
};

void expect_everywhere(const PointField& field, const std::vector<double>& value,
                       double tolerance) {
  ASSERT_EQ(field.components, static_cast<int>(value.size()));
  for (std::size_t i = 0; i < field.values.size(); ++i)
    EXPECT_NEAR(field.values[i], value[i % value.size()], tolerance);
}

// F = A everywhere with det A = 1 and p = 0: neo-Hookean, c1 = 0.75 kPa, stress-free at rest, has
// P = 2 c1 (F − F⁻ᵀ), so S = 2 c1 (I − C⁻¹) and σ = 2 c1 (A Aᵀ − I).
TEST(SolutionFields, OfAHomogeneousStretchAreItsOwn) {
  FatDome dome;
  Eigen::Matrix3d A = Eigen::Vector3d(1.25, 0.8, 1).asDiagonal();
  A(0, 1) = 0.3;  // of the shear, det stays 1
  dome.deform(A);
  const auto fields = solution_fields(dome.press, dome.state);
  const Eigen::Matrix3d C = A.transpose() * A, I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d E = (C - I) / 2, S = 1.5 * (I - C.inverse());
  const Eigen::Matrix3d sigma = 1.5 * (A * A.transpose() - I);
  const Eigen::Matrix3d deviator = sigma - sigma.trace() / 3 * I;
  const Eigen::Vector3d stretches = A.jacobiSvd().singularValues();
  expect_everywhere(fields.at("principal_stretches"), {stretches[0], stretches[1], stretches[2]},
                    1e-9);
  expect_everywhere(fields.at("green_strain"),
                    {E(0, 0), E(1, 1), E(2, 2), E(0, 1), E(1, 2), E(0, 2)}, 1e-9);
  expect_everywhere(fields.at("second_piola_kirchhoff_kPa"),
                    {S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)}, 1e-9);
  expect_everywhere(fields.at("von_mises_kPa"), {std::sqrt(1.5) * deviator.norm()}, 1e-9);
  expect_everywhere(fields.at("mean_pressure_kPa"), {-sigma.trace() / 3}, 1e-9);
  expect_everywhere(fields.at("contact_pressure_kPa"), {0}, 0);
}

TEST(SolutionFields, OfAPressureAloneAreThatPressure) {
  FatDome dome;
  const int pressures = static_cast<int>(dome.state.pressure.size());
  for (int i = 0; i < pressures; i += 8) dome.state.pressure[i] = -3;  // σ = p I
  const auto fields = solution_fields(dome.press, dome.state);
  expect_everywhere(fields.at("mean_pressure_kPa"), {3}, 1e-9);
  expect_everywhere(fields.at("von_mises_kPa"), {0}, 1e-9);
}

// A flat paddle 1 mm inside the outermost skin: where it presses, the pressure is the penalty
// times how deep, and both are 0 at most at the depth itself.
TEST(SolutionFields, OfContactKeepWithinWhatPointsFeel) {
  FatDome probe;
  const auto [low, high] = probe.press.frame().heights(probe.state.x);
  FatDome dome(low - 50, high - 1);
  const auto fields = solution_fields(dome.press, dome.state);
  const auto& gap = fields.at("contact_gap_mm").values;
  const auto& pressure = fields.at("contact_pressure_kPa").values;
  const double deepest = dome.press.penetration(dome.state);
  EXPECT_GT(deepest, 0.5);
  EXPECT_GE(*std::min_element(gap.begin(), gap.end()), -deepest);
  EXPECT_GE(*std::min_element(pressure.begin(), pressure.end()), 0);
  const double largest = *std::max_element(pressure.begin(), pressure.end());
  EXPECT_LE(largest, 2 * deepest + 1e-12);
  EXPECT_GT(largest, 0.2 * deepest);
}

}  // namespace
}  // namespace mammotwin
