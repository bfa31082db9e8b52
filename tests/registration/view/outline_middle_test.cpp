#include "registration/view/outline_middle.h"

#include <gtest/gtest.h>

#include "fitting/mesh/block_mesh.h"
#include "registration/view/view_frame.h"

namespace mammotwin {
namespace {

/// 10 mm of the box's depth lie behind the edge, where it reaches 40 mm farther to the side.
HermiteMesh wider_behind() {
  const HermiteMesh box = block_mesh({20, -60, -40}, {120, 0, 40}, {4, 6, 2});
  std::vector<HermiteMesh::Node> nodes = box.nodes();
  for (HermiteMesh::Node& node : nodes)
    if (node(1, 0) == 0 && node(0, 0) == 120) node(0, 0) = 160;
  return {nodes, box.elements()};
}

TEST(OutlineMiddle, IsThatOfWhatLiesInFrontOfTheEdge) {
  const ViewFrame view{{50, -10, 0}, view_axes(Side::left, 0)};
  EXPECT_NEAR(outline_middle_mm(wider_behind(), view), 20, 1e-9);  // x = 20 to 120 mm
  const ViewFrame behind{{50, 5, 0}, view_axes(Side::left, 0)};
  EXPECT_NEAR(outline_middle_mm(wider_behind(), behind), 40, 1e-9);
}

TEST(OutlineMiddle, OfNothingThereIsNone) {
  EXPECT_THROW(outline_middle_mm(wider_behind(), {{50, -70, 0}, view_axes(Side::left, 0)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace mammotwin
