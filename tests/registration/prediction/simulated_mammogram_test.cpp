#include "registration/prediction/simulated_mammogram.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/registration/squeezed_box.h"

namespace mammotwin {
namespace {

/// Fat with a slab of fibroglandular tissue for x > 70 in the prone box.
Volume<Fractions> half_and_half() {
  Volume<Fractions> f({120, 80, 100}, {1, 1, 1}, {10, -70, -50});
  for (int k = 0; k < f.size.z(); ++k)
    for (int j = 0; j < f.size.y(); ++j)
      for (int i = 0; i < f.size.x(); ++i)
        (f.position(i, j, k).x() > 70 ? f(i, j, k).fibroglandular : f(i, j, k).fat) = 1;
  return f;
}

struct Seen {
  double thickness, attenuation;
};

Seen seen_at(const SimulatedView& view, const Eigen::Vector2d& uv) {
  const DetectorImage& image = view.thickness;
  const Eigen::Vector2d index = (uv - image.first) / image.spacing_mm;
  const int i = static_cast<int>(std::lround(index.x())),
            j = static_cast<int>(std::lround(index.y()));
  return {view.thickness.at(i, j), view.attenuation.at(i, j)};
}

TEST(SimulatedMammogram, AttenuatesAsBeerAndLambertSayAlongTheRay) {
  // The box is 40 mm thick between the plates; a ray at (u, v) is oblique by |source - foot| / D.
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const Volume<Fractions> tissue = half_and_half();
  const Detector detector;
  const SimulatedView view =
      simulate_view(breast.prone, breast.compressed, &tissue, breast.view, detector);
  const Attenuation mu;
  const double millimetre = 1.0;  // voxels end up to half a voxel off at either plate
  for (const Eigen::Vector2d& uv : {Eigen::Vector2d(30, -40), Eigen::Vector2d(40, 30)}) {
    const double path = 40 * std::hypot(660.0, uv.norm()) / 660;
    const Seen seen = seen_at(view, uv);
    EXPECT_NEAR(seen.thickness, path, millimetre);
    const double expected = uv.y() < 0 ? mu.fat : mu.fibroglandular;
    EXPECT_NEAR(seen.attenuation / seen.thickness, expected, 1e-12);
  }
}

TEST(SimulatedMammogram, ShowsFatDarkDenseBrightAndAirBlack) {
  const SqueezedBox breast = squeezed_box(Side::left, 0, 0.5);
  const Volume<Fractions> tissue = half_and_half();
  const SimulatedView view =
      simulate_view(breast.prone, breast.compressed, &tissue, breast.view, Detector{});
  const SimulatedView grey{as_shown(view), as_shown(view)};
  const double fat = seen_at(grey, {30, -40}).thickness, dense = seen_at(grey, {40, 30}).thickness;
  EXPECT_GT(fat, 0.1);
  EXPECT_GT(dense, fat + 0.3);
  for (std::size_t i = 0; i < view.thickness.values.size(); ++i)
    ASSERT_EQ(view.thickness.values[i] == 0, grey.thickness.values[i] == 0);
}

}  // namespace
}  // namespace mammotwin
