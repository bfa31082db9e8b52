#include <gtest/gtest.h>

#include "pipeline/synthesize/map_body.h"

namespace mammotwin {
namespace {

const LabelValues values{{0, ForeignTissue::air},
                         {1, ForeignTissue::fat},
                         {3, ForeignTissue::skin},
                         {4, ForeignTissue::muscle},
                         {7, ForeignTissue::transition}};

/// A slab of skin, fat and a thin sheet of muscle with nothing behind it, as in the maps; the last
/// columns along x have no muscle, and tissue down to the last row of tissue, 24.
Volume<std::uint16_t> slab() {
  Volume<std::uint16_t> map({50, 60, 40}, Eigen::Vector3d::Constant(2), {100, 0, 0}, 0);
  for (int k = 0; k < 40; ++k)
    for (int i = 0; i < 50; ++i)
      for (int j = 5; j < 25; ++j) {
        if (i < 40 && j >= 22) continue;
        map(i, j, k) = j == 5 ? 3 : i < 40 && j >= 20 ? 4 : j == 10 ? 7 : 1;
      }
  return map;
}

std::uint8_t code(Substance s) { return static_cast<std::uint8_t>(s); }

TEST(MapBody, FillsTheThoraxBehindTheMuscle) {
  const MapBody body = body_of_map(slab(), values, 7);
  for (int k = 0; k < 40; ++k)
    for (int i = 0; i < 20; ++i) {  // 40 mm from the flank
      EXPECT_EQ(body.substance(i, 19, k), code(Substance::fat));
      for (int j = 20; j < 25; ++j)  // 10 mm of muscle at least
        EXPECT_EQ(body.substance(i, j, k), code(Substance::muscle));
      for (int j = 38; j < 60; ++j)  // 25 mm of muscle and 8 mm of ribs at most
        EXPECT_GE(body.substance(i, j, k), code(Substance::lung));
    }
}

TEST(MapBody, ContinuesTheFlankWithFatAndSkin) {
  const MapBody body = body_of_map(slab(), values, 7);
  EXPECT_EQ(body.substance(45, 50, 20), code(Substance::fat));
  EXPECT_EQ(body.substance(49, 50, 20), code(Substance::fat)) << "the image's edge is no skin";
  EXPECT_EQ(body.substance(40, 50, 20), code(Substance::fat)) << "nor is what meets the thorax";
  EXPECT_EQ(body.last_y, 48);
  EXPECT_EQ(body.substance.origin.x(), -49) << "the tissue's middle is x = 0";
}

TEST(MapBody, MixesTransitionHalfAndHalf) {
  const TissueMap tissue = body_of_map(slab(), values, 7).sample(2, 3);
  const VoxelMixture& m = tissue.mixtures(20, 10, 20);
  EXPECT_EQ(m[Substance::fat] + m[Substance::fibroglandular], 27);
  EXPECT_NEAR(m[Substance::fibroglandular], 13.5, 0.5);
}

/// Two ridges of fat, 60 mm wide and 40 mm high, on a slab; nothing between and beside them.
TEST(MapBody, PlatesPressTheBreastsFlat) {
  MapBody body;
  body.substance = Volume<std::uint8_t>({100, 40, 4}, Eigen::Vector3d::Constant(2), {-99, 0, 0}, 0);
  body.lesion = body.substance;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 100; ++i)
      for (int j = 0; j < 40; ++j) {
        const double away = std::abs(std::abs(body.substance.position(i, j, k).x()) - 50);
        if (j >= 20 || away < 30) body.substance(i, j, k) = code(Substance::fat);
      }
  press_between_plates(body, 0.8);  // at 50 +- 0.8 * 29 mm
  const auto at = [&](double x, int j) {
    return body.substance(static_cast<int>(std::lround((x + 99) / 2)), j, 1);
  };
  for (const double side : {-1., 1.}) {
    EXPECT_EQ(at(side * 75, 5), code(Substance::air));
    EXPECT_EQ(at(side * 73, 5), code(Substance::skin));
    EXPECT_EQ(at(side * 69, 5), code(Substance::fat));
    EXPECT_EQ(at(side * 27, 5), code(Substance::skin));
    EXPECT_EQ(at(side * 75, 25), code(Substance::fat)) << "behind the breastbone's skin";
  }
}

}  // namespace
}  // namespace mammotwin
