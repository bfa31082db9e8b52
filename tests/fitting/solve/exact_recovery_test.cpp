#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/validation/box_fit.h"
#include "pipeline/validation/known_skins.h"

namespace mammotwin {
namespace {

TEST(Fit, RecoversASkinThatIsAHermiteSurface) { EXPECT_LT(hermite_skin_left_mm(), 1e-6); }

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
