#include "segmentation/body/nipple.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "segmentation/label_maps/label_values.h"

namespace mammotwin {
namespace {

constexpr double dome_mm = 50, peg_mm = 5;
const Eigen::Vector3d middle(0, 60, 0);

/// A half ball of fat, its middle at `middle`, with a rounded peg that ends `height` mm over it;
/// the grid is off by `shift` along each axis.
Volume<std::uint8_t> dome(const Eigen::Vector3d& direction, double height, double shift = 0) {
  Volume<std::uint8_t> labels({100, 60, 100}, Eigen::Vector3d::Constant(1.2),
                              Eigen::Vector3d(-60, 0, -60).array() + shift, label::air);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const Eigen::Vector3d x = labels.position(i, j, k) - middle;
        const double along = std::clamp(x.dot(direction), 0.0, dome_mm + height - peg_mm);
        const bool in_peg = height > 0 && (x - along * direction).norm() < peg_mm;
        if (x.norm() < dome_mm || in_peg) labels(i, j, k) = label::fat;
      }
  return labels;
}

const BreastRegion region{Side::left, -60, 60, -60, 60};

Volume<float> plain(const Volume<std::uint8_t>& labels) { return labels.like<float>(1); }

/// The image with a ball that is half as bright again as the rest.
Volume<float> with_spot(const Volume<std::uint8_t>& labels, const Eigen::Vector3d& x, double mm) {
  Volume<float> look = plain(labels);
  for (int k = 0; k < look.size.z(); ++k)
    for (int j = 0; j < look.size.y(); ++j)
      for (int i = 0; i < look.size.x(); ++i)
        if ((look.position(i, j, k) - x).norm() < mm) look(i, j, k) = 1.5F;
  return look;
}

TEST(Nipple, IsThePegBesideTheMostAnteriorPoint) {
  constexpr double off = 25 * std::numbers::pi / 180;
  const Eigen::Vector3d direction(std::sin(off), -std::cos(off), 0);
  const Volume<std::uint8_t> labels = dome(direction, 6);
  const Nipple nipple = find_nipple(labels, region, plain(labels));
  // The peg's tip, 56 mm from the middle: 24 mm beside the most anterior point.
  EXPECT_TRUE(nipple.is_found);
  EXPECT_LT((nipple.tip_in_lps - (middle + 56 * direction)).norm(), 1.5);
  EXPECT_LT(nipple.sd_mm, 4);
  EXPECT_FALSE(nipple.papilla.values.empty());
  // Nothing is bright: 6 at most for skin that stands out, the rest for the papilla's 5 to 6 mm.
  EXPECT_NEAR(nipple.evidence, 11.5, 1);
}

/// A flat nipple, as an areola that takes up agent with ducts behind it, 24 mm beside the apex.
TEST(Nipple, ShowsByBrightnessWhereNothingStandsOut) {
  constexpr double off = 28 * std::numbers::pi / 180;
  const Eigen::Vector3d place =
      middle + dome_mm * Eigen::Vector3d(std::sin(off), -std::cos(off), 0);
  const Volume<std::uint8_t> labels = dome(-Eigen::Vector3d::UnitY(), 0);
  const Nipple nipple = find_nipple(labels, region, with_spot(labels, place, 9));
  EXPECT_TRUE(nipple.is_found);
  EXPECT_LT((nipple.tip_in_lps - place).norm(), 4) << "9 mm of it are as bright";
  EXPECT_LT(nipple.sd_mm, 8);
}

TEST(Nipple, DoesNotHangOnTheGrid) {
  constexpr double off = 28 * std::numbers::pi / 180;
  const Eigen::Vector3d place =
      middle + dome_mm * Eigen::Vector3d(std::sin(off), -std::cos(off), 0);
  const auto tip = [&](double shift) {
    const Volume<std::uint8_t> labels = dome(-Eigen::Vector3d::UnitY(), 0, shift);
    return find_nipple(labels, region, with_spot(labels, place, 9)).tip_in_lps;
  };
  const Eigen::Vector3d there = tip(0);
  for (const double shift : {0.3, 0.6, 0.9})
    EXPECT_LT((tip(shift) - there).norm(), 0.8) << "grid off by " << shift << " mm";
}

TEST(Nipple, IsUnsureOfTwoPlacesThatLookAlike) {
  constexpr double off = 20 * std::numbers::pi / 180;
  const Volume<std::uint8_t> labels = dome(-Eigen::Vector3d::UnitY(), 0);
  const auto at = [&](double angle) -> Eigen::Vector3d {
    return middle + dome_mm * Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0);
  };
  Volume<float> look = with_spot(labels, at(off), 8);
  const Volume<float> other = with_spot(labels, at(-off), 8);
  for (std::size_t v = 0; v < look.values.size(); ++v)
    look.values[v] = std::max(look.values[v], other.values[v]);
  const Nipple nipple = find_nipple(labels, region, look);
  // 34 mm apart and of equal weight: 24 mm.
  EXPECT_GT(nipple.sd_mm, 12);
}

TEST(Nipple, IsTheMostAnteriorPointWhereNothingShows) {
  const Volume<std::uint8_t> labels = dome(-Eigen::Vector3d::UnitY(), 0);
  const Nipple nipple = find_nipple(labels, region, plain(labels));
  EXPECT_FALSE(nipple.is_found);
  EXPECT_LT((nipple.tip_in_lps - Eigen::Vector3d(0, 10, 0)).norm(), 1.5);
}

TEST(Nipple, PapillaIsSkinAndNotGland) {
  const Eigen::Vector3d direction = -Eigen::Vector3d::UnitY();
  Segmentation s;
  s.labels = dome(direction, 8);
  for (std::uint8_t& value : s.labels.values)
    if (value == label::fat) value = label::fibroglandular;
  s.fractions = s.labels.like<Fractions>(pure_fractions(label::fibroglandular));
  label_papilla(find_nipple(s.labels, region, plain(s.labels)), s);
  const auto at = [&](double along) {
    const Eigen::Vector3i v =
        s.labels.index(middle + along * direction).array().round().cast<int>();
    return std::pair(s.labels(v.x(), v.y(), v.z()),
                     s.fractions(v.x(), v.y(), v.z()).fibroglandular);
  };
  EXPECT_EQ(at(dome_mm + 5), std::pair(label::skin, 0.0F));
  EXPECT_EQ(at(dome_mm - 5), std::pair(label::fibroglandular, 1.0F)) << "below the papilla";
}

}  // namespace
}  // namespace mammotwin
