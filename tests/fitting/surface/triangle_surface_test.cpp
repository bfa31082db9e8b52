#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "fitting/surface/closest_point.h"
#include "fitting/surface/flatten.h"

namespace mammotwin {
namespace {

/// y = −h(x, z) over [−2, 2]², n x n quads halved; normals towards −y.
TriangleSurface sheet(int n, double height = 0) {
  TriangleSurface s;
  for (int k = 0; k <= n; ++k)
    for (int i = 0; i <= n; ++i) {
      const double x = -2 + 4.0 * i / n, z = -2 + 4.0 * k / n;
      s.vertices.emplace_back(x, -height * std::exp(-(x * x + z * z)), z);
    }
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      const int v = i + (n + 1) * k;
      s.triangles.push_back({v, v + 1, v + n + 2});
      s.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return s;
}

const BreastRegion region{Side::left, -1.3, 1.1, -0.9, 1.7};

TriangleSurface cut_to_region(TriangleSurface s) {
  s = clip(s, 0, region.x_min, true, 1e-3);
  s = clip(s, 0, region.x_max, false, 1e-3);
  s = clip(s, 2, region.z_min, true, 1e-3);
  return clip(s, 2, region.z_max, false, 1e-3);
}

double area(const TriangleSurface& s) {
  double sum = 0;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    sum += s.area_vector(static_cast<int>(t)).norm();
  return sum;
}

TEST(TriangleSurface, ClippingKeepsTheAreaInside) {
  EXPECT_NEAR(area(cut_to_region(sheet(17))), 2.4 * 2.6, 1e-12);
}

TEST(TriangleSurface, ClippedSheetIsADiscWithOneBoundaryLoop) {
  const TriangleSurface s = cut_to_region(sheet(17, 1));
  EXPECT_EQ(euler_characteristic(s), 1);
  ASSERT_EQ(boundary_loops(s).size(), 1u);
  EXPECT_EQ(why_not_a_square(s, region), "");
}

TEST(TriangleSurface, LargestPartDropsTheRest) {
  TriangleSurface s = sheet(3);
  const int n = static_cast<int>(s.vertices.size());
  s.vertices.insert(s.vertices.end(), {{9, 0, 0}, {9, 0, 1}, {10, 0, 0}});
  s.triangles.push_back({n, n + 1, n + 2});
  EXPECT_NEAR(area(largest_part(s)), 16, 1e-12);
  EXPECT_EQ(largest_part(s).vertices.size(), 16u);
}

TEST(Flatten, RefusesWhatIsNoDisc) {
  TriangleSurface holed = cut_to_region(sheet(17));
  holed.triangles.erase(holed.triangles.begin() + holed.triangles.size() / 2);
  EXPECT_NE(why_not_a_square(holed, region).find("not a disc"), std::string::npos);
  EXPECT_THROW(flatten(holed, region), std::runtime_error);
  EXPECT_NE(why_not_a_square(sheet(4), region).find("corner"), std::string::npos);
  EXPECT_EQ(why_not_a_square({}, region), "it is empty");
}

TEST(Flatten, AFlatSheetKeepsItsProportions) {
  // Cotangents reproduce linear maps, and the border by arc length is linear here.
  const TriangleSurface s = cut_to_region(sheet(17));
  const FlatSkin flat = flatten(s, region);
  for (std::size_t v = 0; v < s.vertices.size(); ++v) {
    EXPECT_NEAR(flat.uv[v].x(), (s.vertices[v].x() - region.x_min) / 2.4, 1e-6);
    EXPECT_NEAR(flat.uv[v].y(), (s.vertices[v].z() - region.z_min) / 2.6, 1e-6);
  }
}

TEST(Flatten, FlipsNoTriangleOfABell) {
  const TriangleSurface s = cut_to_region(sheet(40, 4));
  const FlatSkin flat = flatten(s, region);
  for (const auto& t : s.triangles) {
    const Eigen::Vector2d a = flat.uv[t[1]] - flat.uv[t[0]], b = flat.uv[t[2]] - flat.uv[t[0]];
    EXPECT_GT(a.x() * b.y() - a.y() * b.x(), 0);
  }
}

TEST(Flatten, EdgesRunFromCornerToCorner) {
  const TriangleSurface s = cut_to_region(sheet(17, 1));
  const FlatSkin flat = flatten(s, region);
  for (int edge = 0; edge < 4; ++edge) {
    const int fixed = edge / 2;
    for (std::size_t i = 0; i < flat.edges[edge].size(); ++i) {
      const Eigen::Vector2d uv = flat.uv[flat.edges[edge][i]];
      EXPECT_NEAR(uv[fixed], edge % 2, 1e-12);
      if (i == 0) continue;
      EXPECT_GT(uv[1 - fixed], flat.uv[flat.edges[edge][i - 1]][1 - fixed]);
    }
    EXPECT_NEAR(flat.uv[flat.edges[edge].front()][1 - fixed], 0, 1e-12);
    EXPECT_NEAR(flat.uv[flat.edges[edge].back()][1 - fixed], 1, 1e-12);
  }
}

TEST(ClosestPoint, FindsTheFootOnASheet) {
  const ClosestPoint closest(sheet(8));
  const auto hit = closest({0.3, 1.7, -0.2});
  EXPECT_LT((hit.x - Eigen::Vector3d(0.3, 0, -0.2)).norm(), 1e-12);
  EXPECT_NEAR(std::abs(hit.normal.y()), 1, 1e-12);
  EXPECT_LT((closest({5, 0, 0}).x - Eigen::Vector3d(2, 0, 0)).norm(), 1e-12);
}

// An edge that lies in one cut plane and crosses another has its corner in both, to the last bit.
TEST(Clip, CornersLieInBothPlanes) {
  for (int n = 1; n < 200; ++n) {
    const double x = 0.892259 + 0.001 * n, z = -89.948752 + 0.01 * n;
    const TriangleSurface triangle{{{x, 0, z - 0.7}, {x, 1, z + 1.1}, {x + 2, 0.5, z}},
                                   {{0, 1, 2}}};
    const TriangleSurface part = clip(triangle, 2, z, true, 0);
    int corners = 0;
    for (const Eigen::Vector3d& v : part.vertices) corners += v.x() == x && v.z() == z;
    EXPECT_EQ(corners, 1) << n;
  }
}

}  // namespace
}  // namespace mammotwin
