#include "pipeline/steps/view_problem.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mammotwin
