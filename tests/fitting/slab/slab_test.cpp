#include "fitting/slab/slab.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fitting/flat_target.h"

namespace mammotwin {
namespace {

constexpr double kFlatSide = FlatTarget::side, kFlatDepth = FlatTarget::depth;
const BreastRegion kRegion{Side::left, 0, kFlatSide, 0, kFlatSide};
const Eigen::Vector3i kElements(3, 2, 2);

HermiteMesh start_of(const FlatTarget& flat) {
  return straight_start(flat.slab, flat.skin, flat.flat, flat.wall, kRegion);
}

/// Calls `use` with each element and 27 ξ in it, and how far through the slab they are (u, v, w).
template <class Use>
void everywhere(const Use& use) {
  for (int k = 0; k < kElements.z(); ++k)
    for (int j = 0; j < kElements.y(); ++j)
      for (int i = 0; i < kElements.x(); ++i)
        for (int n = 0; n < 27; ++n) {
          const Eigen::Vector3d xi = Eigen::Vector3d(n % 3, n / 3 % 3, n / 9) / 2;
          const Eigen::Vector3d uvw =
              (Eigen::Vector3d(i, j, k) + xi).cwiseQuotient(kElements.cast<double>());
          use(MeshPoint{Slab{kElements}.element(i, j, k), xi}, uvw);
        }
}

// A plane has no second derivatives to smooth, so least squares give it back to rounding.
TEST(Slab, StartsAsABrickBetweenTwoPlanes) {
  const FlatTarget flat(kElements, 3);
  const HermiteMesh start = start_of(flat);
  everywhere([&](const MeshPoint& p, const Eigen::Vector3d& uvw) {
    const Eigen::Vector3d x(kFlatSide * uvw.x(), -(kFlatDepth + 3) * uvw.z(), kFlatSide * uvw.y());
    EXPECT_LT((start.position(p) - x).norm(), 1e-9);
  });
}

// y = -10 - 8 u³v² lies among bicubic surfaces. Smoothing of 1e-7 times squared second derivatives
// of at most 48 mm in a unit square bends it by about the square root of 1e-7 48²: 15 µm.
TEST(Slab, StartsOnABicubicSkin) {
  FlatTarget flat(kElements, 0);
  const auto skin_y = [](double u, double v) { return -kFlatDepth - 8 * u * u * u * v * v; };
  for (std::size_t n = 0; n < flat.skin.vertices.size(); ++n)
    flat.skin.vertices[n].y() = skin_y(flat.flat.uv[n].x(), flat.flat.uv[n].y());
  const HermiteMesh start = start_of(flat);
  everywhere([&](const MeshPoint& p, const Eigen::Vector3d& uvw) {
    EXPECT_NEAR(start.position(p).y(), uvw.z() * skin_y(uvw.x(), uvw.y()), 0.015);
  });
}

TEST(Slab, HeldParametersAreThoseThatKeepTheSidesInTheirPlanes) {
  const FlatTarget flat(kElements, 0);
  const HeldParameters held = held_parameters(flat.slab);
  const auto farthest_off = [&](const std::vector<HermiteMesh::Node>& nodes) {
    const HermiteMesh mesh(nodes, flat.box.elements());
    double off = 0;
    everywhere([&](const MeshPoint& p, const Eigen::Vector3d& uvw) {
      const Eigen::Vector3d x = mesh.position(p);
      if (uvw.x() == 0 || uvw.x() == 1) off = std::max(off, std::abs(x.x() - kFlatSide * uvw.x()));
      if (uvw.y() == 0 || uvw.y() == 1) off = std::max(off, std::abs(x.z() - kFlatSide * uvw.y()));
    });
    return off;
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-3, 3);
  std::vector<HermiteMesh::Node> nodes = flat.box.nodes();
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int p = 0; p < 24; ++p)
      if (!held[n][p]) nodes[n].data()[p] += uniform(random);
  EXPECT_LT(farthest_off(nodes), 1e-12);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int p = 0; p < 24; ++p) {
      if (!held[n][p]) continue;
      std::vector<HermiteMesh::Node> moved = flat.box.nodes();
      moved[n].data()[p] += 1;
      EXPECT_GT(farthest_off(moved), 1e-3) << "node " << n << ", parameter " << p;
    }
}

TEST(Slab, FacesAreLabelledByWhereTheyLie) {
  const FlatTarget flat(kElements, 0);
  const std::vector<FaceLabels> faces = slab_faces(flat.slab);
  ASSERT_EQ(static_cast<int>(faces.size()), flat.box.num_elements());
  for (int e = 0; e < flat.box.num_elements(); ++e)
    for (int face = 0; face < 6; ++face) {
      Eigen::Vector3d xi = Eigen::Vector3d::Constant(0.5);
      xi[face / 2] = face % 2;
      const Eigen::Vector3d x = flat.box.position({e, xi});
      const bool on_side =
          std::min(x.x(), x.z()) < 1e-9 || std::max(x.x(), x.z()) > kFlatSide - 1e-9;
      const FaceLabel expected = x.y() > -1e-9                ? FaceLabel::chest_wall
                                 : x.y() < -kFlatDepth + 1e-9 ? FaceLabel::skin
                                 : on_side                    ? FaceLabel::cut
                                                              : FaceLabel::interior;
      EXPECT_EQ(faces[e][face], expected) << "element " << e << ", face " << face;
    }
}

}  // namespace
}  // namespace mammotwin
