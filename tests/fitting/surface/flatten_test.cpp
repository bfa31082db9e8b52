#include "fitting/surface/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace mammotwin {
namespace {

const BreastRegion hill_region{Side::left, -2, 3, 10, 14};

/// A height field over the region on a grid, its triangles and vertices in a random order.
TriangleSurface shuffled_hill(int seed) {
  constexpr int nx = 6, nz = 5;
  std::mt19937 random(seed);
  std::vector<int> place(nx * nz);
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  TriangleSurface surface;
  surface.vertices.resize(nx * nz);
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i)
      surface.vertices[place[i + nx * k]] = {hill_region.x_min + i, -0.3 * i * k,
                                             hill_region.z_min + k};
  for (int k = 0; k + 1 < nz; ++k)
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = i + nx * k;
      surface.triangles.push_back({place[a], place[a + 1], place[a + nx + 1]});
      surface.triangles.push_back({place[a], place[a + nx + 1], place[a + nx]});
    }
  std::shuffle(surface.triangles.begin(), surface.triangles.end(), random);
  return surface;
}

// The border may begin anywhere; the library lays the first corner that it meets at (0, 0).
TEST(Flatten, LaysXAlongUAndZAlongVWhereverTheBorderBegins) {
  for (int seed = 0; seed < 20; ++seed) {
    const TriangleSurface hill = shuffled_hill(seed);
    const FlatSkin flat = flatten(hill, hill_region);
    for (std::size_t v = 0; v < hill.vertices.size(); ++v) {
      const double u = (hill.vertices[v].x() - hill_region.x_min) / 5;
      const double w = (hill.vertices[v].z() - hill_region.z_min) / 4;
      EXPECT_EQ(u == 0, flat.uv[v].x() == 0) << "seed " << seed;
      EXPECT_EQ(u == 1, flat.uv[v].x() == 1) << "seed " << seed;
      EXPECT_EQ(w == 0, flat.uv[v].y() == 0) << "seed " << seed;
      EXPECT_EQ(w == 1, flat.uv[v].y() == 1) << "seed " << seed;
    }
  }
}

/// The hill with a vertex inside split in two: a second one, near by at an angle from x, takes the
/// triangles on the side of greater x, and two slivers join them.
TriangleSurface split_hill(double angle) {
  constexpr double distance = 1e-5;
  TriangleSurface hill = shuffled_hill(1);
  const auto vertex = [&](double i, double k) {
    const auto is_there = [&](const Eigen::Vector3d& x) {
      return x.x() == hill_region.x_min + i && x.z() == hill_region.z_min + k;
    };
    const auto& v = hill.vertices;
    return static_cast<int>(std::find_if(v.begin(), v.end(), is_there) - v.begin());
  };
  const int split = vertex(2, 2), added = static_cast<int>(hill.vertices.size());
  for (auto& t : hill.triangles) {
    double x = 0;
    for (int v : t) x += hill.vertices[v].x() / 3;
    if (x > hill.vertices[split].x()) std::replace(t.begin(), t.end(), split, added);
  }
  const double i = 2 + distance * std::cos(angle), k = 2 + distance * std::sin(angle);
  hill.triangles.push_back({split, added, vertex(2, 3)});
  hill.triangles.push_back({split, vertex(2, 1), added});
  hill.vertices.push_back({hill_region.x_min + i, -0.3 * i * k, hill_region.z_min + k});
  return hill;
}

// Contours of label maps are full of slivers, and a micrometre turns their short edges.
TEST(Flatten, AShortEdgeThatTurnsMovesNothing) {
  const FlatSkin flat = flatten(split_hill(-1), hill_region);
  const FlatSkin turned = flatten(split_hill(1), hill_region);
  // The edge is 1e-5 long and the shorter side of the region 4.
  for (std::size_t v = 0; v < flat.uv.size(); ++v)
    EXPECT_LT((turned.uv[v] - flat.uv[v]).norm(), 1e-5) << "vertex " << v;
}

}  // namespace
}  // namespace mammotwin
