#include "solver/element/dead_forces.h"

#include <gtest/gtest.h>

#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

/// Work of the forces on a displacement of the dome [mN mm].
double work_on(const DeadForces& forces, const HermiteMesh& mesh,
               const std::vector<HermiteMesh::Node>& displacement) {
  double work = 0;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int a = 0; a < kFunctions; ++a)
      work += forces[e].row(a).dot(
          displacement[mesh.corners(e)[corner_of_function(a)]].col(parameter_of_function(a)));
  return work;
}

/// A pressure's work is -p times the volume that the skin sweeps: of u = (x, 0, 0) over a closed
/// skin, the volume inside.
TEST(DeadForces, OfAPressureWorkAgainstTheVolumeThatTheSkinSweeps) {
  MeshFile box{box_mesh({10, 20, 30}, {1, 2, 1}), {}, {}, {}, {}, {}};
  for (int e = 0; e < box.mesh.num_elements(); ++e) {
    FaceLabels labels;
    labels.fill(FaceLabel::skin);
    labels[e == 0 ? 3 : 2] = FaceLabel::interior;
    box.faces.push_back(labels);
  }
  const DeadForces forces = forces_of_pressure(box, [](const auto&, const auto&) { return 2.0; });
  auto growth = box.mesh.nodes();
  for (auto& node : growth) node.bottomRows(2).setZero();  // x stays, y and z go
  EXPECT_NEAR(work_on(forces, box.mesh, growth), -2 * 10 * 20 * 30, 1e-8);
  auto shift = growth;
  for (auto& node : shift) node.setZero(), node(1, 0) = 1;
  EXPECT_NEAR(work_on(forces, box.mesh, shift), 0, 1e-9) << "a closed skin is not moved";
}

TEST(DeadForces, ActWhereThePressureDoesAndOnSkinOnly) {
  const MeshFile dome = dome_breast({2, 2, 2});
  const DeadForces left = forces_of_pressure(
      dome, [](const Eigen::Vector3d& x, const Eigen::Vector3d&) { return x.x() > 5 ? 1.0 : 0.0; });
  for (int e = 0; e < dome.mesh.num_elements(); ++e) {
    const bool pressed = e % 2 == 1 && e >= 4;  // the elements of greater x, in front
    EXPECT_EQ(left[e].isZero(), !pressed) << e;
  }
  EXPECT_EQ(scaled(left, 3)[5], 3 * left[5]);
}

}  // namespace
}  // namespace mammotwin
