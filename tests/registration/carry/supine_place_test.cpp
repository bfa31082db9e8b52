#include "registration/carry/supine_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

/// A box of y from -60 to 0 whose front is skin, and the same sunk to half its height.
struct LyingBox {
  SqueezedBox box = squeezed_box(Side::left, 0, 0.5);
  MeshFile prone{box.prone, {}, {}, {}, {}, {}};
  std::vector<HermiteMesh::Node> nodes = box.prone.nodes();

  explicit LyingBox(FaceLabel front) {
    for (int e = 0; e < prone.mesh.num_elements(); ++e) {
      FaceLabels faces;
      faces.fill(FaceLabel::cut);
      // The face that lies in front, whichever of the element's axes runs along y.
      for (int face = 0; face < 6; ++face) {
        Eigen::Vector3d xi = Eigen::Vector3d::Constant(0.5);
        xi[face / 2] = face % 2;
        if (prone.mesh.position({e, xi}).y() < -60 + 1e-9) faces[face] = front;
      }
      prone.faces.push_back(faces);
    }
    for (HermiteMesh::Node& node : nodes) node.row(1) *= 0.5;
  }
};

// The lesion at y = -20 lies at -10, 20 mm below the skin at -30; the nipple at (70, -60, 0) at
// -30.
TEST(SupinePlace, IsTheSkinStraightAboveTheLesion) {
  const LyingBox lying(FaceLabel::skin);
  const HermiteMesh supine(lying.nodes, lying.prone.mesh.elements());
  const auto place = supine_place(lying.prone, supine, Side::left, {70, -20, -25}, {70, -60, 0});
  ASSERT_TRUE(place);
  EXPECT_LT((place->skin_in_lps - Eigen::Vector3d(70, -30, -25)).norm(), 0.02);  // bisection
  EXPECT_NEAR(place->depth_mm, 20, 0.02);
  EXPECT_NEAR(place->from_nipple_mm, 25, 0.02);
  EXPECT_EQ(place->clock, "6");
}

TEST(SupinePlace, IsTheLessSureTheFartherFromTheNipple) {
  const LyingBox lying(FaceLabel::skin);
  const HermiteMesh supine(lying.nodes, lying.prone.mesh.elements());
  const auto place = supine_place(lying.prone, supine, Side::left, {70, -20, -25}, {70, -60, 0});
  ASSERT_TRUE(place);
  EXPECT_LT((place->lesion_in_lps - Eigen::Vector3d(70, -10, -25)).norm(), 0.02);
  const Eigen::Vector3d share = place->semi_axes_mm / std::hypot(40, 25);
  EXPECT_LT((share - Eigen::Vector3d(0.67, 0.60, 0.39)).norm(), 0.01);
}

TEST(SupinePlace, IsNotSaidWhereTheModelEndsWithoutSkin) {
  const LyingBox lying(FaceLabel::cut);
  const HermiteMesh supine(lying.nodes, lying.prone.mesh.elements());
  EXPECT_FALSE(supine_place(lying.prone, supine, Side::left, {70, -20, -25}, {70, -60, 0}));
}

}  // namespace
}  // namespace mammotwin
