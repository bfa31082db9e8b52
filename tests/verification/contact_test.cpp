#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/material/neo_hookean.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin::contact_test {
namespace {

constexpr double kC1 = 3;  // [kPa]

/// A body on symmetry planes at x, y, z = 0, pressed by an endless plate from above.
struct PressedBody {
  HermiteMesh mesh;
  Model model;
  DofMap dofs{mesh};
  std::shared_ptr<PlateContact> contact = std::make_shared<PlateContact>();
  FaceList top;
  State state = model.rest();

  PressedBody(const HermiteMesh& m, double bulk_ratio)
      : mesh(m),
        model(mesh, uniform(std::make_shared<NeoHookean>(kC1)),
              {PressureSpace::trilinear, bulk_ratio, 0}) {
    for (int axis = 0; axis < 3; ++axis) hold_plane(mesh, axis, 0, dofs);
    contact->points1d = 10;
    for (int e = 0; e < mesh.num_elements(); ++e)  // the layer on top
      if (mesh.corners(e)[7] >= mesh.num_nodes() - top_nodes()) top.push_back({e, 5});
    for (const auto& [e, face] : top)
      model.add_surface_potential(e, face, contact, contact->points1d);
  }
  int top_nodes() const {
    int count = 0;
    while (count < mesh.num_nodes() && mesh.node(count)(2, 0) < 1e-9) ++count;
    return count;
  }
  void hold_underside() {
    for (const auto& [e, face] : faces_at(mesh, 2, 0))
      for (int i = 0; i < 3; ++i)
        for (int dof : face_dofs(mesh, e, face, i)) dofs.prescribe(dof);
  }
  ContactFigures press(double height, double penalty) {
    dofs.number(mesh);
    contact->plates = {Plate{{0, 0, height}, {0, 0, -1}, {0, 1, 0}, 0, true}};
    Newton newton(model, dofs);
    PenaltyOptions options;
    options.last = penalty;
    const NewtonReport report = solve_contact(newton, *contact, 1, options, state);
    EXPECT_TRUE(report.usable()) << report.reason;
    return contact_figures(model, state, *contact, 0, top);
  }
  template <class Visit>
  void for_contact_points(Visit visit) const {
    for (const auto& [e, number] : top)
      for (const Face& face : model.faces(e))
        for (int q = 0; q < face.num_points(); ++q) {
          const Eigen::Vector3d x =
              face.deformed(model.coefficients(state.x, e), q).template head<3>();
          visit(x, contact->pressure(contact->plates[0].gap(x).gap), face.point(q).area);
        }
  }
};

// Contact patch test. Elements are bent inside a block whose outside is straight; the plate's
// pressure is uniform and the state homogeneous: λ along z, λ^(−1/2) across, nominal pressure
// 2c₁(λ⁻² − λ). Derivatives of the quadratic map by differences are good to 1e-7.
TEST(Contact, PatchTestOnDistortedElements) {
  constexpr double L = 20, H = 24;
  const auto bend = [](const Eigen::Vector3d& xi) {
    const double x = xi.x(), y = xi.y(), z = xi.z();
    return Eigen::Vector3d(L * (x + 0.4 * x * (1 - x) * (y + z - 1)),
                           L * (y + 0.4 * y * (1 - y) * (x - z)),
                           H * (z + 0.4 * z * (1 - z) * (x - y)));
  };
  PressedBody block(mapped_mesh({2, 2, 2}, bend), 1e6);
  block.press(0.75 * H, 1e4);
  const double stretch = block.state.x.back()(2, 0) / H;
  const double pressure = 2 * kC1 * (1 / (stretch * stretch) - stretch);
  block.for_contact_points([&](const Eigen::Vector3d&, double p, double) {
    EXPECT_NEAR(p / pressure, 1, 2e-5);  // kappa/mu = 1e6, and 1e4 kPa/mm on 1e-8 mm
  });
  const double across = 1 / std::sqrt(stretch);
  for (int i = 0; i < block.mesh.num_nodes(); ++i) {
    const Eigen::Vector3d X = block.mesh.node(i).col(0);
    const Eigen::Vector3d x(across * X.x(), across * X.y(), stretch * X.z());
    EXPECT_NEAR((block.state.x[i].col(0) - x).norm(), 0, 2e-5);
  }
}

// Hertz: an incompressible paraboloid of radius R on a rigid flat plate. E* = E/(1 − ν²) = 8c₁, and
// with F the force of the whole, a = (3FR / 4E*)^(1/3), pressure p₀ √(1 − r²/a²), p₀ = 3F/(2πa²)
// (Johnson, Contact Mechanics, section 4.2); its mean over r < a/2 is p₀ (8/3)(1 − (3/4)^(3/2)),
// and that of r² weighted with it 2a²/5, which gives the radius found. F over a is local: the
// block, 6a deep and wide, touches it at order (a/H)³. F over the approach is not, and is not
// compared. Left are the strain, a/R = 3 %, and faces of 2 to 6 mm, which a circle's edge crosses.
TEST(Contact, HertzParaboloidOnARigidPlate) {
  constexpr double R = 300, L = 60, H = 60;
  const auto graded = [](double s) { return s * (0.2 + 0.8 * s * s); };
  const auto paraboloid = [&](const Eigen::Vector3d& xi) {
    const double x = L * graded(xi.x()), y = L * graded(xi.y());
    const double z = H * (1 - graded(1 - xi.z()));
    return Eigen::Vector3d(x, y, z * (1 - (x * x + y * y) / (2 * R * H)));
  };
  PressedBody body(mapped_mesh({6, 6, 3}, paraboloid), 1e4);
  body.hold_underside();
  const double force = 4 * body.press(H - 0.31, 100).force.norm(), modulus = 8 * kC1;
  const double radius = std::cbrt(3 * force * R / (4 * modulus));
  const double peak = 3 * force / (2 * std::numbers::pi * radius * radius);
  double second_moment = 0, inner_area = 0, inner_force = 0;
  body.for_contact_points([&](const Eigen::Vector3d& x, double p, double area) {
    const double r = x.head<2>().norm();
    second_moment += 4 * p * area * r * r;
    if (r > radius / 2) return;
    inner_area += area;
    inner_force += p * area;
  });
  const double found = std::sqrt(2.5 * second_moment / force);
  const double expected = peak * 8 / 3 * (1 - std::pow(0.75, 1.5));
  EXPECT_NEAR(found / radius, 1, 0.02);
  EXPECT_NEAR(inner_force / inner_area / expected, 1, 0.02);
}

}  // namespace
}  // namespace mammotwin::contact_test
