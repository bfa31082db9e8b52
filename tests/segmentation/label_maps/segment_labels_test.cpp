#include <fstream>

#include "segmentation/files/read_labels.h"
#include "segmentation/files/write_image_file.h"
#include "segmentation/image/crop.h"
#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// A label map with other numbers: two half-ball breasts of 50 mm at x = -75 and 75, z = 0, on a
/// chest with its front at y = 60; fat 11, skin 12 (3 mm), muscle 13, a lesion 14 on the left, and
/// where that is asked for a voxel of it on the right.
fs::path write_foreign_map(const fs::path& folder, bool speck = false) {
  Volume<float> map({110, 60, 70}, Eigen::Vector3d::Constant(3), {-163.5, -10, -103.5}, 0);
  for (int k = 0; k < map.size.z(); ++k)
    for (int j = 0; j < map.size.y(); ++j)
      for (int i = 0; i < map.size.x(); ++i) {
        const Eigen::Vector3d x = map.position(i, j, k);
        const double r = std::min((x - Eigen::Vector3d(-75, 60, 0)).norm(),
                                  (x - Eigen::Vector3d(75, 60, 0)).norm());
        const double outside = std::min(r - 50, 48 - x.y());
        if (outside < 0) map(i, j, k) = outside > -3 ? 12 : 11;
        if (x.y() > 60 && x.y() < 75) map(i, j, k) = 13;  // an empty thorax behind
        if ((x - Eigen::Vector3d(80, 40, 5)).norm() < 8) map(i, j, k) = 14;
        if (x.y() > 75) map(i, j, k) = 0;
      }
  if (speck) map(30, 17, 35) = 14;
  write_image(folder / "map.nrrd", map);
  return folder / "map.nrrd";
}

SegmentInput foreign_input(const fs::path& folder, bool speck = false) {
  SegmentInput input;
  input.label_map = write_foreign_map(folder, speck);
  input.label_values = {{11, ForeignTissue::fat},
                        {12, ForeignTissue::skin},
                        {13, ForeignTissue::muscle},
                        {14, ForeignTissue::lesion}};
  return input;
}

/// Bumps of 4 mm that stand `off` mm to each side of the left breast's apex, or one.
SegmentInput bumpy_input(const fs::path& folder, const std::vector<double>& off) {
  Volume<float> map({80, 70, 80}, Eigen::Vector3d::Constant(1.5), {20, -15, -60}, 0);
  const Eigen::Vector3d base(75, 60, 0);
  for (int k = 0; k < map.size.z(); ++k)
    for (int j = 0; j < map.size.y(); ++j)
      for (int i = 0; i < map.size.x(); ++i) {
        const Eigen::Vector3d x = map.position(i, j, k);
        double r = (x - base).norm() - 60;
        for (const double angle : off) {
          const Eigen::Vector3d tip =
              base + 59 * Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0);
          r = std::min(r, (x - tip).norm() - 5);
        }
        if (x.y() < 75 && std::min(r, 48 - x.y()) < 0) map(i, j, k) = x.y() > 60 ? 13 : 11;
      }
  write_image(folder / "map.nrrd", map);
  SegmentInput input;
  input.label_map = folder / "map.nrrd";
  input.side = Side::left;
  input.label_values = {{11, ForeignTissue::fat}, {13, ForeignTissue::muscle}};
  return input;
}

TEST(SegmentLabels, OnlyABumpWithoutRivalsIsTheNipple) {
  const EmptyFolder folder("bumps");
  const auto nipple = [&](const std::vector<double>& off) {
    return segment(bumpy_input(folder.path, off), {}).quality;
  };
  const auto one = nipple({0.35});
  EXPECT_LT(
      (one.nipple_in_lps - Eigen::Vector3d(75 + 64 * std::sin(0.35), 60 - 64 * std::cos(0.35), 0))
          .norm(),
      2);
  EXPECT_LT(one.nipple_sd_mm, 5);
  const auto two = nipple({0.35, -0.35});
  EXPECT_NEAR(two.nipple_in_lps.x(), 75, 2) << "the most anterior point, between the two";
  EXPECT_GT(two.nipple_sd_mm, 20);
}

TEST(SegmentLabels, TakesTheLesionsSideAndDropsTheOther) {
  const EmptyFolder folder("foreign");
  const SegmentResult result = segment(foreign_input(folder.path), {});
  const Segmentation& s = result.segmentation;
  EXPECT_EQ(s.region.side, Side::left);
  EXPECT_GE(s.labels.position(5, 0, 0).x(), -3) << "cropped to the left half";
  ASSERT_EQ(s.lesions.size(), 1U);
  EXPECT_LT((s.lesions[0].centroid_in_lps - Eigen::Vector3d(80, 40, 5)).norm(), 1);
  // Half a ball of 50 mm beyond 12 mm of coat; region and skin are coarse at 3 mm.
  EXPECT_NEAR(s.nipple_in_lps.x(), 75, 3);
  EXPECT_NEAR(s.nipple_in_lps.y(), 10, 3);
  EXPECT_NEAR(result.quality.skin_thickness_mm, 3, 1.5);
  const double in_tissues =
      result.quality.fat_ml + result.quality.skin_ml + result.quality.lesions[0].volume_ml;
  EXPECT_NEAR(in_tissues, result.quality.breast_volume_ml, 1e-6);
}

TEST(SegmentLabels, ASpeckOfALesionsLabelOnTheOtherSideIsNoLesionAndIsSaid) {
  const EmptyFolder folder("speck");
  const SegmentResult result = segment(foreign_input(folder.path, true), {});
  EXPECT_EQ(result.segmentation.region.side, Side::left);
  EXPECT_EQ(result.segmentation.lesions.size(), 1U);
  ASSERT_EQ(result.quality.notes.size(), 1U);
  expect_mentions(result.quality.notes[0],
                  {"1 part of lesion labels", "0.027 ml at (-74, 41, 2) mm LPS", "radius_mm"});
}

TEST(SegmentLabels, FillsTheThoraxBehindTheMuscle) {
  const EmptyFolder folder("thorax");
  const Segmentation s = segment(foreign_input(folder.path), {}).segmentation;
  const Eigen::Vector3i deep = s.labels.index({75, 100, 0}).array().round().cast<int>();
  EXPECT_EQ(s.labels(deep.x(), deep.y(), deep.z()), label::muscle);
}

TEST(SegmentLabels, TheSideCanBeNamed) {
  const EmptyFolder folder("side");
  SegmentInput input = foreign_input(folder.path);
  input.side = Side::right;
  const SegmentResult result = segment(input, {});
  EXPECT_EQ(result.quality.side, Side::right);
  EXPECT_TRUE(result.segmentation.lesions.empty());
  EXPECT_NEAR(result.segmentation.nipple_in_lps.x(), -75, 3);
}

TEST(SegmentLabels, ASphereIsALesion) {
  const EmptyFolder folder("sphere");
  SegmentInput input = foreign_input(folder.path);
  input.lesions = {{"b", Eigen::Vector3d(60, 35, -10), 9.0, {}, {}, {}}};
  const SegmentResult result = segment(input, {});
  ASSERT_EQ(result.segmentation.lesions.size(), 2U);
  const Lesion& lesion = result.segmentation.lesions[1];
  EXPECT_EQ(lesion.id, "b");
  EXPECT_LT((lesion.centroid_in_lps - Eigen::Vector3d(60, 35, -10)).norm(), 1);
  EXPECT_NEAR(lesion.volume_ml, 4.0 / 3 * 3.14159 * 0.729, 0.3);  // voxels of 0.027 ml
}

TEST(SegmentLabels, APointNamesTheLesionNearIt) {
  const EmptyFolder folder("named");
  SegmentInput input = foreign_input(folder.path);
  input.lesions = {{"biopsy", Eigen::Vector3d(83, 38, 2), {}, {}, {}, {}}};
  EXPECT_EQ(segment(input, {}).segmentation.lesions[0].id, "biopsy");
  input.lesions[0].point_in_lps = Eigen::Vector3d(60, 35, -40);
  expect_mentions(message_of([&] { segment(input, {}); }), {"biopsy", "no lesion within 10 mm"});
}

TEST(SegmentLabels, AnUnclearSideIsRefused) {
  const EmptyFolder folder("unclear");
  SegmentInput input = foreign_input(folder.path);
  input.label_values[14] = ForeignTissue::fat;
  expect_mentions(message_of([&] { segment(input, {}); }), {"side is not clear", "patient.toml"});
}

/// The foreign map as 3D Slicer saves it: numbered anew from 1, known by names and terminology.
fs::path write_slicer_segments(const fs::path& folder) {
  const Volume<std::uint16_t> foreign = read_labels(write_foreign_map(folder));
  auto labels = foreign.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    labels.values[v] =
        foreign.values[v] ? static_cast<std::uint8_t>(foreign.values[v] - 10) : label::air;
  std::map<std::string, std::string> keys;
  int n = 0;
  for (const auto& [name, tags] :
       std::vector<std::pair<std::string, std::string>>{{"Breast FAT", ""},
                                                        {"Segment_2", "SCT^39937001^Skin"},
                                                        {"Pectoral", ""},
                                                        {"Tumour upper", ""}}) {
    const std::string prefix = "Segment" + std::to_string(n++) + "_";
    keys[prefix + "Name"] = name;
    keys[prefix + "LabelValue"] = std::to_string(n);
    keys[prefix + "Layer"] = "0";
    keys[prefix + "Tags"] = "TerminologyEntry:" + tags;
  }
  FileGrid grid;
  for (int a = 0; a < 3; ++a)
    grid.size[a] = labels.size[a], grid.spacing[a] = 3, grid.origin[a] = labels.origin[a];
  write_nrrd(folder / "slicer.seg.nrrd", grid, labels.values.data(), 1, keys);
  return folder / "slicer.seg.nrrd";
}

TEST(SegmentLabels, SegmentsOfSlicerAreKnownByNameNotByValue) {
  const EmptyFolder folder("slicer");
  SegmentInput input;
  input.label_map = write_slicer_segments(folder.path);
  const Segmentation by_name = segment(input, {}).segmentation;
  const Segmentation by_value = segment(foreign_input(folder.path), {}).segmentation;
  EXPECT_EQ(by_name.labels.values, by_value.labels.values);
  ASSERT_EQ(by_name.lesions.size(), 1U);
  EXPECT_EQ(by_name.lesions[0].id, "Tumour upper");
}

TEST(SegmentLabels, GoesOnFromItsOwnProductCorrectedByHand) {
  const EmptyFolder folder("resume");
  const Segmentation first = segment(foreign_input(folder.path), {}).segmentation;
  Segmentation corrected = first;
  const Eigen::Vector3i v = first.labels.index({75, 45, 0}).array().round().cast<int>();
  corrected.labels(v.x(), v.y(), v.z()) = label::fibroglandular;
  write_segmentation(folder.path / "a.seg.nrrd", corrected);
  SegmentInput input;
  input.label_map = folder.path / "a.seg.nrrd";
  input.side = Side::left;
  const Segmentation again = segment(input, {}).segmentation;
  EXPECT_EQ(again.labels.values, corrected.labels.values);
  EXPECT_EQ(again.fractions(v.x(), v.y(), v.z()).fibroglandular, 1);
}

}  // namespace
}  // namespace mammotwin
