#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "solver/contact/plate.h"
#include "solver/contact/plate_contact.h"
#include "solver/contact/pressed_gap.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

/// A tilted paddle: face normal along −up, edge rounded by 10 mm.
Plate paddle() {
  const Eigen::Matrix3d R(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()));
  return {{1, 2, 3}, R * Eigen::Vector3d(0, 0, -1), R * Eigen::Vector3d(0, -1, 0), 10, false};
}

Eigen::Vector3d at(const Plate& plate, double above, double behind, double sideways) {
  return plate.point + above * plate.normal - behind * plate.depth +
         sideways * plate.normal.cross(plate.depth);
}

TEST(Plate, GapIsTheDistanceToFaceRoundingAndWall) {
  const Plate plate = paddle();
  EXPECT_NEAR(plate.gap(at(plate, 4, -20, 7)).gap, 4, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -2, -20, 7)).gap, -2, 1e-12);
  // Centre of the rounding lies 10 above-less: (3, 4) from it is 5 − 10 inside, (9, 12) 5 outside.
  EXPECT_NEAR(plate.gap(at(plate, -10 + 3, 4, 0)).gap, -5, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -10 + 9, 12, 0)).gap, 5, 1e-12);
  EXPECT_NEAR(plate.gap(at(plate, -30, 13, 0)).gap, 3, 1e-12);
}

TEST(Plate, NormalAndHessianAreDerivativesOfTheGap) {
  const Plate plate = paddle();
  std::mt19937 random(3);
  const auto uniform = [&] { return 30 * (random() / 4294967295.0) - 15; };
  constexpr double h = 1e-5;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d x = at(plate, uniform(), uniform(), uniform());
    const Gap exact = plate.gap(x);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d dx = h * Eigen::Vector3d::Unit(k);
      const Gap plus = plate.gap(x + dx), minus = plate.gap(x - dx);
      // Curvature jumps where regions meet; there one side's difference is a mixture.
      if ((plus.hessian - minus.hessian).norm() > 1e-3) continue;
      EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), exact.normal[k], 1e-7);
      EXPECT_NEAR(((plus.normal - minus.normal) / (2 * h) - exact.hessian.col(k)).norm(), 0, 1e-6);
    }
  }
}

TEST(PlateContact, PushesOnlyWhatIsInside) {
  PlateContact contact;
  contact.plates = {paddle()};
  contact.penalty = 7;
  SurfaceResponse response;
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  y.head<3>() = at(paddle(), 0.1, -5, 0);
  EXPECT_FALSE(contact.respond(y, {}, 2, response));
  y.head<3>() = at(paddle(), -0.1, -5, 0);
  ASSERT_TRUE(contact.respond(y, {}, 2, response));
  EXPECT_NEAR(response.energy, 7 * 0.1 * 0.1 / 2, 1e-12);
  EXPECT_NEAR((response.gradient.head<3>() + 0.7 * paddle().normal).norm(), 0, 1e-12);
}

// The top of a block of 20 mm under a plate that leans into it, by 0.01 x: ∫gap²/∫gap.
TEST(ContactFigures, MeanGapIsWeighedByPressure) {
  constexpr double slope = 0.01;
  const HermiteMesh mesh = box_mesh({20, 20, 10}, {1, 1, 1});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  const auto contact = std::make_shared<PlateContact>();
  contact->penalty = 7;
  contact->plates = {{{0, 10, 10}, {-slope, 0, -std::sqrt(1 - slope * slope)}, {0, 1, 0}, 0, true}};
  model.add_surface_potential(0, 5, contact, contact->points1d);
  const ContactFigures figures = contact_figures(model, model.rest(), *contact, 0, {{0, 5}});
  EXPECT_NEAR(figures.mean_gap, 2.0 / 3 * 20 * slope, 1e-12);
  EXPECT_NEAR(figures.load, 7 * 10 * slope * 400, 1e-9);
}

double area_of(const std::vector<WeighedGap>& gaps) {
  double area = 0;
  for (const WeighedGap& g : gaps) area += g.area;
  return area;
}

// A trough 1 mm deep across a block of 20 mm, z = 10 − c x (20 − x), that touches a plate at its
// rims: its gap is under c (100 − t²) but in the middle 2t mm of it, and so at 95 % of the area for
// t = 0.5. The points' areas there are 0.5 mm wide: good to 0.005 mm.
TEST(PressedGap, OfATroughIsItsDepth) {
  constexpr double c = 0.01, into = 0.02;  // the outermost points lie 0.018 mm deep
  const HermiteMesh mesh = box_mesh({20, 20, 10}, {2, 1, 1});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  const auto contact = std::make_shared<PlateContact>();
  FaceList faces;
  for (const double height : {0.0, 10.0})  // the lower face looks away
    for (const auto& [e, face] : faces_at(mesh, 2, height)) {
      faces.push_back({e, face});
      model.add_surface_potential(e, face, contact, 12);
    }
  State state = model.rest();
  for (auto& node : state.x)
    if (const double x = node(0, 0); node(2, 0) > 5) {
      node(2, 0) -= c * x * (20 - x);
      node(2, 1) -= 10 * c * (20 - 2 * x);
    }
  const Plate plate{{10, 10, 10 - into}, {0, 0, -1}, {0, 1, 0}, 0, true};
  const auto gaps = pressed_gaps(model, state, plate, faces, 12);
  EXPECT_NEAR(gap_percentile(gaps, 0.95), c * (100 - 0.25) - into, 0.005);
  // Its slope c (20 − 2x) has the mean square 400 c²/3, which makes it 2/3 % longer than wide; at
  // its open ends a triangle of the shape is missing.
  EXPECT_NEAR(area_of(gaps), 400 * (1 + 200 * c * c / 3), 8);
}

// Rims 40 mm apart leave room for a circle that none of them is in: nothing lies between them.
TEST(PressedGap, DoesNotReachAcrossATroughThatIsTooWide) {
  const HermiteMesh mesh = box_mesh({40, 20, 10}, {2, 1, 1});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  const auto contact = std::make_shared<PlateContact>();
  for (const auto& [e, face] : faces_at(mesh, 2, 10))
    model.add_surface_potential(e, face, contact, 12);
  State state = model.rest();
  for (auto& node : state.x)
    if (const double x = node(0, 0); node(2, 0) > 5) {
      node(2, 0) -= 0.01 * x * (40 - x);
      node(2, 1) -= 0.2 * (40 - 2 * x);
    }
  const Plate plate{{20, 10, 9.7}, {0, 0, -1}, {0, 1, 0}, 0, true};
  const auto gaps = pressed_gaps(model, state, plate, faces_at(mesh, 2, 10), 12);
  ASSERT_FALSE(gaps.empty());
  EXPECT_LE(gap_percentile(gaps, 1), 0);
}

TEST(PressedGap, EndsWhereThePlatesFlatFaceEnds) {
  const HermiteMesh mesh = box_mesh({40, 20, 10}, {2, 1, 1});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  const auto contact = std::make_shared<PlateContact>();
  for (const auto& [e, face] : faces_at(mesh, 2, 10))
    model.add_surface_potential(e, face, contact, 12);
  const auto gaps = [&](bool endless) {
    const Plate plate{{20, 10, 9.9}, {0, 0, -1}, {1, 0, 0}, 0, endless};
    return pressed_gaps(model, model.rest(), plate, faces_at(mesh, 2, 10), 12);
  };
  EXPECT_NEAR(area_of(gaps(true)), 800, 16);
  EXPECT_NEAR(area_of(gaps(false)), 400, 16);
}

// What lies below a fold looks at the plate, too: here the face between two blocks, 20 mm down.
TEST(PressedGap, IsNotThatOfSkinBehindAFold) {
  const HermiteMesh mesh = box_mesh({20, 20, 40}, {1, 1, 2});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  const auto contact = std::make_shared<PlateContact>();
  const FaceList faces{{0, 5}, {1, 5}};
  for (const auto& [e, face] : faces) model.add_surface_potential(e, face, contact, 12);
  const Plate plate{{10, 10, 39.9}, {0, 0, -1}, {0, 1, 0}, 0, true};
  const auto gaps = pressed_gaps(model, model.rest(), plate, faces, 12);
  EXPECT_NEAR(gap_percentile(gaps, 1), -0.1, 1e-9);
  EXPECT_NEAR(area_of(gaps), 400, 8);
}

TEST(PressedGap, OfABlockThatDoesNotTouchIsNone) {
  const HermiteMesh mesh = box_mesh({20, 20, 10}, {1, 1, 1});
  Model model(mesh, uniform(std::make_shared<NeoHookean>(1)), {});
  model.add_surface_potential(0, 5, std::make_shared<PlateContact>(), 12);
  const Plate plate{{10, 10, 11}, {0, 0, -1}, {0, 1, 0}, 0, true};
  EXPECT_TRUE(pressed_gaps(model, model.rest(), plate, {{0, 5}}, 12).empty());
  EXPECT_EQ(gap_percentile({}, 0.95), 0);
}

}  // namespace
}  // namespace mammotwin
