// What stages leave for one another in a mesh file comes back as it was; a damaged field is named.

#include "fitting/mesh/block_mesh.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/registered_record.h"
#include "pipeline/steps/solution_record.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

using MeshRecords = ScratchFolder;

MeshFile one_element() {
  return {block_mesh({0, 0, 0}, {60, 60, 60}, {1, 1, 1}), {}, {}, {}, {}, {}};
}

TEST_F(MeshRecords, ASolutionComesBackNumberByNumber) {
  MeshFile file = one_element();
  EXPECT_FALSE(read_solution(file, "cc.vtu"));
  write_solution({{1.5, -2}, 1, 2, 3, 4, 5, 6, 12, {{7, 1, {8, 9, 10}, 11}}}, file);
  const auto found = read_solution(file, "cc.vtu");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->pressure_kpa, (std::vector<double>{1.5, -2}));
  EXPECT_EQ(found->support_height_mm, 1);
  EXPECT_EQ(found->paddle_height_mm, 2);
  EXPECT_EQ(found->edge_mm, 3);
  EXPECT_EQ(found->lateral_middle_mm, 4);
  EXPECT_EQ(found->penalty_kpa_per_mm, 5);
  EXPECT_EQ(found->target_thickness_mm, 6);
  EXPECT_EQ(found->drawn_times, 12);
  ASSERT_EQ(found->holds.size(), 1u);
  EXPECT_EQ(found->holds[0].point, 7);
  EXPECT_EQ(found->holds[0].plate, 1);
  EXPECT_EQ(found->holds[0].anchor, Eigen::Vector3d(8, 9, 10));
  EXPECT_EQ(found->holds[0].pressure, 11);
  erase_solution(file);
  EXPECT_FALSE(read_solution(file, "cc.vtu"));
}

TEST_F(MeshRecords, ADamagedFieldIsNamed) {
  MeshFile file = one_element();
  write_solution({}, file);
  file.metadata.at("plates").push_back(0);
  const std::string message = message_of([&] { read_solution(file, "cc.vtu"); });
  EXPECT_NE(message.find("cc.vtu: the field plates has 7 numbers; expected 6"), std::string::npos)
      << message;
}

TEST_F(MeshRecords, WhatRegisterKnowsComesBack) {
  MeshFile file = one_element();
  RegisteredRecord::Baseline baseline;
  baseline.frame.origin_in_lps = {1, 2, 3};
  baseline.frame.axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  baseline.thickness_mm = 50;
  baseline.turn_deg = -3;
  baseline.shift_mm = {4, -5};
  ViewUncertainty uncertainty;
  uncertainty.sd[kRoll] = 7;
  uncertainty.covariance(kTilt, kRoll) = 0.25;
  uncertainty.varied[kRoll] = file.mesh.nodes();
  uncertainty.discrepancy_mm = 4.5;
  uncertainty.edge = {-20, {30, -4}};
  WhatIfShapes what_if;
  what_if[1] = {file.mesh.nodes(), file.mesh.nodes()};
  what_if[1].down[0](2, 0) -= 5;
  write_registered({baseline, uncertainty, what_if, SearchEnd::look}, file);
  for (const auto& [name, nodes] : file.configurations)
    EXPECT_TRUE(is_of_registration(name)) << name;

  const RegisteredRecord found = read_registered(file, "cc_registered.vtu");
  ASSERT_TRUE(found.baseline && found.uncertainty);
  EXPECT_EQ(found.baseline->frame.origin_in_lps, baseline.frame.origin_in_lps);
  EXPECT_EQ(found.baseline->frame.axes, baseline.frame.axes);
  EXPECT_EQ(found.baseline->thickness_mm, 50);
  EXPECT_EQ(found.baseline->turn_deg, -3);
  EXPECT_EQ(found.baseline->shift_mm, baseline.shift_mm);
  EXPECT_EQ(found.uncertainty->sd, uncertainty.sd);
  EXPECT_EQ(found.uncertainty->covariance, uncertainty.covariance);
  EXPECT_EQ(found.uncertainty->discrepancy_mm, 4.5);
  EXPECT_EQ(found.uncertainty->edge.turn_deg, -20);
  EXPECT_EQ(found.uncertainty->edge.shift_mm, uncertainty.edge.shift_mm);
  EXPECT_EQ(found.end, SearchEnd::look);
  EXPECT_EQ(found.uncertainty->varied[kRoll].size(), file.mesh.nodes().size());
  EXPECT_TRUE(found.uncertainty->varied[kTilt].empty());
  EXPECT_EQ(found.what_if[1].up[0], what_if[1].up[0]);
  EXPECT_EQ(found.what_if[1].down[0], what_if[1].down[0]);
  EXPECT_TRUE(found.what_if[0].up.empty());
}

TEST_F(MeshRecords, AMeshWithoutFaceLabelsIsNoBreast) {
  const std::string message = message_of([&] { breast_problem(one_element(), {}, {}, 1); });
  EXPECT_NE(message.find("face_labels has 0 rows; expected 1"), std::string::npos) << message;
}

}  // namespace
}  // namespace mammotwin
