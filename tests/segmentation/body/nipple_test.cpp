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

/// A half ball of fat, its middle at `middle`, with a rounded peg that ends `height` mm over it.
Volume<std::uint8_t> dome(const Eigen::Vector3d& direction, double height) {
  Volume<std::uint8_t> labels({100, 60, 100}, Eigen::Vector3d::Constant(1.2), {-60, 0, -60},
                              label::air);
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

TEST(Nipple, IsThePegBesideTheMostAnteriorPoint) {
  constexpr double off = 25 * std::numbers::pi / 180;
  const Eigen::Vector3d direction(std::sin(off), -std::cos(off), 0);
  const Nipple nipple = find_nipple(dome(direction, 6), region);
  // The peg's tip, 56 mm from the middle: 24 mm beside the most anterior point.
  EXPECT_LT((nipple.tip_in_lps - (middle + 56 * direction)).norm(), 1.5);
  EXPECT_GT(nipple.stands_out_mm, 4);
}

TEST(Nipple, IsTheMostAnteriorPointWhereNothingStandsOut) {
  const Nipple nipple = find_nipple(dome(-Eigen::Vector3d::UnitY(), 0), region);
  EXPECT_EQ(nipple.stands_out_mm, 0);
  EXPECT_LT((nipple.tip_in_lps - Eigen::Vector3d(0, 10, 0)).norm(), 1.5);
}

TEST(Nipple, PapillaIsSkinAndNotGland) {
  const Eigen::Vector3d direction = -Eigen::Vector3d::UnitY();
  Segmentation s;
  s.labels = dome(direction, 8);
  for (std::uint8_t& value : s.labels.values)
    if (value == label::fat) value = label::fibroglandular;
  s.fractions = s.labels.like<Fractions>(pure_fractions(label::fibroglandular));
  label_papilla(find_nipple(s.labels, region), s);
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
