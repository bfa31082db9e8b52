#include "registration/view/breast_middle.h"

#include <gtest/gtest.h>

#include "fitting/mesh/block_mesh.h"
#include "registration/view/view_frame.h"

namespace mammotwin {
namespace {

/// 100 mm wide in front of y = -10 mm; behind that 40 mm wider to the side.
HermiteMesh wider_behind() {
  const HermiteMesh box = block_mesh({20, -60, -40}, {120, 0, 40}, {4, 6, 2});
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  for (HermiteMesh::Node& node : nodes)
    if (node(1, 0) == 0 && node(0, 0) == 120) node(0, 0) = 160;
  return {nodes, box.elements()};
}

TEST(BreastMiddle, IsThatOfTheTissueInFrontOfTheEdge) {
  const ViewFrame view{{50, -10, 0}, view_axes(Side::left, 0)};
  EXPECT_NEAR(breast_middle_mm(wider_behind(), view), 20, 1e-9);  // x = 20 to 120 mm
  const ViewFrame right{{-50, -10, 0}, view_axes(Side::right, 0)};
  EXPECT_NEAR(breast_middle_mm(wider_behind(), right), -120, 1e-9);
}

// The last of six elements is wider, to one side: the middle of the two ends is 40 mm.
TEST(BreastMiddle, HangsLittleOnWhatEndsNearTheEdge) {
  const ViewFrame view{{50, 0, 0}, view_axes(Side::left, 0)};
  const double middle = breast_middle_mm(wider_behind(), view);
  EXPECT_GT(middle, 20);
  EXPECT_LT(middle, 23);
}

TEST(BreastMiddle, OfNothingThereIsNone) {
  EXPECT_THROW(breast_middle_mm(wider_behind(), {{50, -70, 0}, view_axes(Side::left, 0)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
