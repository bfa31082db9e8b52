#include "pipeline/steps/view_problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "pipeline/steps/typical_thickness.h"
#include "registration/view/view_frame.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

TEST(ViewProblem, OnlyAnAssumedThicknessEndsAtTheMostForce) {
  Patient patient;
  patient.compression.most_force_n = 120;
  const MeshFile dome = dome_breast({4, 4, 2});
  const auto problem = [&](const ViewSettings& view) {
    return view_problem(patient, view, view_axes(Side::left, 0), dome, lumpy_tissue());
  };
  ViewSettings view;
  const CompressionProblem assumed = problem(view);
  EXPECT_EQ(assumed.most_force, 120);
  EXPECT_EQ(assumed.plates.thickness, assumed_thickness_mm(dome, assumed.plates));
  view.thickness_mm = 50;
  EXPECT_EQ(problem(view).plates.thickness, 50);
  EXPECT_EQ(problem(view).most_force, std::numeric_limits<double>::infinity());
}

TEST(ViewProblem, ABreastIsDrawnForwardByItsWeightOrWhatAHandDrawsWith) {
  Patient patient;
  patient.compression.pull = 1;
  MeshFile dome = dome_breast({4, 4, 2});
  dome.configurations["prone"] = dome.mesh.nodes();
  const auto drawn = [&](double most_n) {
    patient.compression.most_pull_n = most_n;
    return view_problem(patient, {}, view_axes(Side::left, 0), dome, lumpy_tissue());
  };
  const CompressionProblem hung = drawn(100), held = drawn(1);
  const double weight = patient.gravity.density() * 9810;  // [mN/mm³]
  EXPECT_NEAR((hung.pull - weight * hung.plates.depth).norm(), 0, 1e-9 * weight);
  const double in_front = PlateFrame(dome, held.plates).volume_in_front();
  EXPECT_GT(in_front * weight, 1000) << "mN, and so more than is drawn with";
  EXPECT_NEAR((held.pull - 1000 / in_front * held.plates.depth).norm(), 0, 1e-9 * weight);
}

TEST(ViewProblem, WhatWasDrawnHarderStaysSo) {
  Patient patient;
  patient.compression.pull = 1;
  MeshFile compressed = dome_breast({2, 2, 1});
  compressed.configurations["prone"] = compressed.configurations["unloaded"] =
      compressed.mesh.nodes();
  const auto pull_where_drawn = [&](double times) {
    CompressionResult solved;
    solved.pressure.assign(8 * compressed.mesh.num_elements(), 0);
    solved.penalty = 1;
    solved.report.drawn_times = times;
    remember_solution(solved, compressed);
    const auto solver =
        nearby_solver(patient, {"cc", Side::left, 0, 60, {}}, compressed, lumpy_tissue());
    return solver.value().problem_at(ViewState::Zero()).pull;
  };
  const Eigen::Vector3d once = pull_where_drawn(1);
  EXPECT_GT(once.norm(), 0);
  EXPECT_NEAR((pull_where_drawn(4) - 4 * once).norm(), 0, 1e-12 * once.norm());
}

TEST(ViewProblem, AStateKnowsHowRoundABreastIsThatItsCoilPressed) {
  const Patient patient;
  MeshFile compressed = dome_breast({2, 2, 1});
  const std::vector<HermiteMesh::Node> unloaded = compressed.mesh.nodes();
  std::vector<HermiteMesh::Node> rounder = unloaded;
  for (HermiteMesh::Node& node : rounder) node.row(0) *= 1.25;
  compressed.configurations = {
      {"prone", unloaded}, {"unloaded", unloaded}, {kRounderByCoil, rounder}};
  CompressionResult solved;
  solved.pressure.assign(8 * compressed.mesh.num_elements(), 0);
  solved.penalty = 1;
  remember_solution(solved, compressed);
  const auto solver =
      nearby_solver(patient, {"cc", Side::left, 0, 60, {}}, compressed, lumpy_tissue());
  ASSERT_TRUE(solver);
  const auto widest = [&](double deviations) {
    double most = 0;
    const CompressionProblem problem =
        solver->problem_at(deviations * kCoilRoundnessSd * ViewState::Unit(kCoilRoundness));
    for (const HermiteMesh::Node& node : problem.mesh.mesh.nodes())
      most = std::max(most, node(0, 0));
    return most;
  };
  EXPECT_NEAR(widest(1) / widest(0), 1.25, 1e-12);
  EXPECT_NEAR(widest(-2) / widest(0), 0.5, 1e-12);
}

}  // namespace
}  // namespace mammotwin
