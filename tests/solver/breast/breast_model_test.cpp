#include "solver/breast/breast_model.h"

#include <gtest/gtest.h>

#include "solver/newton/assembler.h"
#include "tests/solver/test_meshes.h"

namespace mammotwin {
namespace {

const Eigen::Vector3d kSize(20, 16, 12);  // [mm]

/// A block of fat that slides on a flat wall under it, with skin on its top.
BreastProblem block_problem(double c1_skin) {
  BreastProblem problem;
  problem.mesh.mesh = box_mesh(kSize, {2, 2, 2});
  for (int e = 0; e < 8; ++e) {
    FaceLabels labels;
    labels.fill(FaceLabel::interior);
    labels[e % 2] = labels[2 + e / 2 % 2] = FaceLabel::cut;
    labels[4 + e / 4] = e < 4 ? FaceLabel::chest_wall : FaceLabel::skin;
    problem.mesh.faces.push_back(labels);
  }
  problem.tissue = [](const Eigen::Vector3d&, double) { return std::array<double, 3>{1, 0, 0}; };
  problem.skin.c1 = c1_skin;
  problem.boundary.chest_wall = ChestWall::free;
  problem.boundary.cut_faces = CutFaces::free;
  return problem;
}

/// Stored by the block when it is strained alike everywhere.
double stored(const BreastProblem& problem, const Eigen::Matrix3d& F) {
  const BreastModel breast = make_breast_model(problem, {});
  State state = breast.model->rest();
  state.x = affine(problem.mesh.mesh, F, {0, 0, 0});
  return Assembler(*breast.model, *breast.dofs).balance(state).energy;
}

/// Stretched and sheared along the wall, as much thinner as keeps the volume.
std::vector<Eigen::Matrix3d> strains() {
  std::vector<Eigen::Matrix3d> all;
  for (const auto& [along, across, shear] :
       {std::array{0.8, 0.8, 0.0}, std::array{0.7, 0.95, 0.0}, std::array{0.9, 0.8, 0.2}}) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    F << along, shear, 0, 0, across, 0, 0, 0, 1 / (along * across);
    all.push_back(F);
  }
  return all;
}

// A layered body strained alike in all layers stores, at J = 1, (tr FᵀF − 3) times each layer's
// c₁ and volume. The mesh holds the skin's volume as fat, so its fat is (height − h) thick.
TEST(BreastModel, FatAndSkinStoreWhatALayeredBodyStores) {
  const BreastProblem problem = block_problem(3.3);
  const double fat = problem.laws.laws[0]->shear_modulus() / 2, h = problem.skin.thickness;
  for (const Eigen::Matrix3d& F : strains()) {
    const double layered =
        kSize.x() * kSize.y() * ((kSize.z() - h) * fat + h * 3.3) * (F.squaredNorm() - 3);
    EXPECT_NEAR(stored(problem, F) / layered, 1, 1e-10);
  }
}

TEST(BreastModel, SkinNoStifferThanFatAddsNothing) {
  BreastProblem none = block_problem(3.3);
  none.skin.on = false;
  for (const double c1 : {0.1, 0.75}) {
    const BreastProblem soft = block_problem(c1);
    for (const Eigen::Matrix3d& F : strains()) EXPECT_EQ(stored(soft, F), stored(none, F)) << c1;
  }
}

}  // namespace
}  // namespace mammotwin
