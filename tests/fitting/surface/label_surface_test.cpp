#include "fitting/surface/label_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mammotwin {
namespace {

// A block whose faces pass exactly through nodes: at its edges and its corner two or three edges of
// the grid meet the boundary in one node.
TEST(LabelSurface, HasNoTrianglesWithoutAreaWhereNodesLieOnTheBoundary) {
  constexpr int kNodes = 9, kFace = 4;
  constexpr double kSpacing_mm = 2;
  const Eigen::Vector3d origin(-30.7742, -8.9548, -63.6);
  Volume<float> solid(Eigen::Vector3i::Constant(kNodes), Eigen::Vector3d::Constant(kSpacing_mm),
                      origin, 0);
  for (int k = 0; k < kNodes; ++k)
    for (int j = 0; j < kNodes; ++j)
      for (int i = 0; i < kNodes; ++i)
        solid(i, j, k) =
            std::clamp(0.5F + 0.25F * static_cast<float>(kFace - std::max({i, j, k})), 0.F, 1.F);
  const TriangleSurface surface = solid_boundary(solid);
  ASSERT_FALSE(surface.triangles.empty());
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d a = surface.vertices[t[0]];
    const Eigen::Vector3d b = surface.vertices[t[1]] - a, c = surface.vertices[t[2]] - a;
    EXPECT_GT(b.cross(c).norm(), 0);
  }
  for (const Eigen::Vector3d& v : surface.vertices)
    EXPECT_NEAR((v - origin).maxCoeff(), kFace * kSpacing_mm, 1e-3);
}

}  // namespace
}  // namespace mammotwin
