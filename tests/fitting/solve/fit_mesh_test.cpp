#include "fitting/solve/fit_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fitting/surface/skin_to_fit.h"
#include "tests/fitting/dome.h"

namespace mammotwin {
namespace {

/// The skin's points moved at random, those at its edges within their planes.
TriangleSurface jittered(TriangleSurface skin, const BreastRegion& region, double by_mm) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, by_mm);
  for (Eigen::Vector3d& x : skin.vertices) {
    const bool at_x = x.x() == region.x_min || x.x() == region.x_max;
    const bool at_z = x.z() == region.z_min || x.z() == region.z_max;
    const Eigen::Vector3d move(normal(random), normal(random), normal(random));
    x += Eigen::Vector3d(at_x ? 0 : move.x(), move.y(), at_z ? 0 : move.z());
  }
  return skin;
}

std::vector<HermiteMesh::Node> fitted_to(const Segmentation& s, const MuscleFront& wall,
                                         const TriangleSurface& skin, const BreastRegion& region) {
  const FlatSkin flat = flatten(skin, region);
  const FitGoal goal{skin, flat, wall.height, region, s.nipple_in_lps};
  FitReport report;
  report.smoothing = 1e-8;
  return fit_mesh(slab_around_nipple({4, 4, 2}, goal), goal, {}, report, {}).mesh.nodes();
}

// 0.4 um of a skin is what rounding and the contour's ties come to.
TEST(FitMesh, ASkinMovedByAMicrometreMovesNodesByMicrometres) {
  Segmentation s = dome_breast();
  s.nipple_in_lps = {2.3, -51.8, 1.1};
  const MuscleFront wall = find_muscle_front(s.labels, s.region);
  const SkinToFit skin = find_skin_to_fit(s, wall);
  const auto as_it_is = fitted_to(s, wall, skin.surface, skin.region);
  const auto moved = fitted_to(s, wall, jittered(skin.surface, skin.region, 4e-4), skin.region);
  double farthest = 0;
  for (std::size_t n = 0; n < moved.size(); ++n)
    farthest = std::max(farthest, (moved[n].col(0) - as_it_is[n].col(0)).norm());
  EXPECT_LT(farthest, 0.05);
  RecordProperty("farthest_mm", std::to_string(farthest));
}

}  // namespace
}  // namespace mammotwin
