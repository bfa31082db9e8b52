#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fitting/mesh/block_mesh.h"
#include "fitting/slab/skin_patches.h"
#include "pipeline/validation/box_fit.h"

namespace mammotwin {
namespace {

TEST(Fit, RecoversASkinThatIsAHermiteSurface) {
  const Slab slab{{3, 3, 1}};
  std::vector<HermiteMesh::Node> truth = box_nodes(slab);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // The skin's parameters 0 to 3 of its nodes move by up to 6 mm along y, its sides stay in planes.
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 3; ++i)
      for (int d = 0; d < 4; ++d) truth[slab.node(i, j, 1)](1, d) += 6 * uniform(random);
  const HermiteMesh true_mesh(truth, grid_corners(slab.elements));
  const SkinPatches patches(slab, true_mesh);
  const Skin skin = [&](double u, double v) { return patches.at({3 * u, 3 * v}).x; };
  std::vector<HermiteMesh::Node> nodes = box_nodes(slab);
  // So near the truth nothing has to be held from sliding, and Newton's method is quadratic.
  EXPECT_LT(fit_box(slab, skin, {61, 12, 0}, nodes), 1e-6);
}

// Cubics follow a smooth surface to the fourth power of their size.
TEST(Fit, ConvergesWithTheFourthPowerOfTheElementSize) {
  std::vector<double> error;
  for (int n : {5, 10}) {
    const Slab slab{{n, n, 1}};
    std::vector<HermiteMesh::Node> nodes = box_nodes(slab);
    error.push_back(fit_box(slab, bell_on_box, {}, nodes));
    RecordProperty("rms_" + std::to_string(n), std::to_string(error.back()));
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
}

}  // namespace
}  // namespace mammotwin
