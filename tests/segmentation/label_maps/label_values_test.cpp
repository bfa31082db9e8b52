#include "segmentation/label_maps/label_values.h"

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

const LabelValues foreign{{1, ForeignTissue::fat},    {2, ForeignTissue::fibroglandular},
                          {3, ForeignTissue::skin},   {4, ForeignTissue::muscle},
                          {5, ForeignTissue::lesion}, {7, ForeignTissue::transition}};

Volume<std::uint16_t> map_of(std::uint16_t value) {
  return {{8, 8, 8}, Eigen::Vector3d::Constant(2), Eigen::Vector3d::Zero(), value};
}

TEST(LabelValues, EachTissueGetsTheProjectsLabel) {
  for (const auto& [value, own] : std::vector<std::pair<int, int>>{{0, label::air},
                                                                   {1, label::fat},
                                                                   {2, label::fibroglandular},
                                                                   {3, label::skin},
                                                                   {4, label::muscle},
                                                                   {5, label::lesion}})
    EXPECT_EQ(map_labels(map_of(value), foreign).labels(4, 4, 4), own) << value;
}

TEST(LabelValues, TransitionIsHalfFatHalfFibroglandular) {
  auto map = map_of(1);
  map(4, 4, 4) = 7;
  const MappedLabels mapped = map_labels(map, foreign);
  EXPECT_EQ(mapped.fractions(4, 4, 4).fat, 0.5F);
  EXPECT_EQ(mapped.fractions(4, 4, 4).fibroglandular, 0.5F);
  EXPECT_EQ(mapped.labels(4, 4, 4), label::fat) << "most neighbours are fat";
}

/// Voxels of 0.008 ml: three parts of one value, of 6, 3 and 1 voxels, and one of another, of 3.
Volume<std::uint16_t> map_of_parts() {
  auto map = map_of(1);
  for (int k = 4; k < 7; ++k) map(5, 5, k) = map(5, 6, k) = map(1, 1, k - 3) = 5;
  map(7, 0, 0) = 5;
  map(0, 7, 5) = map(0, 7, 6) = map(0, 7, 7) = 6;
  return map;
}

LabelValues two_lesion_values() {
  LabelValues values = foreign;
  values[6] = ForeignTissue::lesion;
  return values;
}

TEST(LabelValues, LesionsAreConnectedPartsLargestFirst) {
  auto map = map_of_parts();
  for (int k = 0; k < 8; ++k) map(3, 3, k) = map(3, 2, k) = 5;
  const auto labels = map_labels(map, two_lesion_values()).labels;
  EXPECT_EQ(labels(3, 3, 3), label::lesion);
  EXPECT_EQ(labels(0, 7, 6), label::lesion + 1) << "the largest of its value, if small";
  EXPECT_EQ(labels(5, 5, 5), label::fibroglandular) << "0.048 ml, smaller than a ball of 5 mm";
}

TEST(LabelValues, SpecksOfALesionAreCountedAndNoLesions) {
  const MappedLabels mapped = map_labels(map_of_parts(), two_lesion_values());
  EXPECT_EQ(mapped.labels(5, 5, 5), label::lesion);
  EXPECT_EQ(mapped.labels(1, 1, 2), label::fibroglandular);
  EXPECT_EQ(mapped.fractions(1, 1, 2).lesion, 0);
  EXPECT_EQ(mapped.specks.parts, 2U);
  EXPECT_DOUBLE_EQ(mapped.specks.largest_ml, 0.024);
  EXPECT_EQ(mapped.specks.largest_in_lps, Eigen::Vector3d(2, 2, 2));
}

TEST(LabelValues, ASpeckThatIsNamedIsALesion) {
  const auto labels = map_labels(map_of_parts(), two_lesion_values(), {{14, 0, 2}}).labels;
  EXPECT_EQ(labels(7, 0, 0), label::lesion + 2) << "2 mm from the point named";
  EXPECT_EQ(labels(1, 1, 2), label::fibroglandular) << "12 mm from it";
}

TEST(LabelValues, ASpeckNearANamedLesionIsNone) {
  auto map = map_of_parts();
  map(7, 5, 4) = 5;  // 2 mm from the point, the lesion 4 mm
  const MappedLabels mapped = map_labels(map, two_lesion_values(), {{14, 10, 10}});
  EXPECT_EQ(mapped.labels(7, 5, 4), label::fibroglandular);
  EXPECT_EQ(mapped.labels(5, 5, 5), label::lesion);
}

TEST(LabelValues, AValueWithoutANameIsAnError) {
  expect_mentions(message_of([] { map_labels(map_of(9), foreign); }),
                  {"value 9", "1 fat", "7 transition"});
}

TEST(LabelValues, WordsAreReadAndUnknownOnesListed) {
  EXPECT_EQ(foreign_tissue("transition"), ForeignTissue::transition);
  expect_mentions(message_of([] { foreign_tissue("gland"); }), {"gland", "fibroglandular"});
}

}  // namespace
}  // namespace mammotwin
