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

TEST(LabelValues, LesionsAreConnectedPartsLargestFirst) {
  auto map = map_of(1);
  map(1, 1, 1) = map(1, 1, 2) = map(1, 1, 3) = 5;
  for (int k = 4; k < 7; ++k) map(5, 5, k) = map(5, 6, k) = 5;
  map(7, 0, 0) = 5;  // one voxel of 0.008 ml is noise
  const auto labels = map_labels(map, foreign).labels;
  EXPECT_EQ(labels(5, 5, 5), label::lesion);
  EXPECT_EQ(labels(1, 1, 2), label::lesion + 1);
  EXPECT_EQ(labels(7, 0, 0), label::fibroglandular);
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
