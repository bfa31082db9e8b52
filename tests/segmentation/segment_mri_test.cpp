#include <algorithm>
#include <cmath>
#include <fstream>

#include "segmentation/image/crop.h"
#include "segmentation/mirrored.h"
#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"
#include "tests/segmentation/message.h"
#include "tests/segmentation/phantom_input.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

class SegmentMri : public testing::TestWithParam<bool> {};

TEST_P(SegmentMri, FindsThePartsOfThePhantom) {
  const EmptyFolder folder("phantom");
  Phantom phantom;
  phantom.fat_suppressed = GetParam();
  phantom.shading = 0.7;  // fat falls to half from front to back
  const SegmentResult result = segment(input_for(write_phantom(folder.path, phantom), phantom), {});
  const Segmentation& s = result.segmentation;
  EXPECT_EQ(result.quality.contrast, GetParam() ? "fat-suppressed" : "not fat-suppressed");
  EXPECT_EQ(s.region.side, Side::left);
  EXPECT_NEAR(s.region.x_min, 0, 4) << "the valley is at x = 0";

  // Labels against the closed form, away from the surfaces by a voxel, in the region.
  std::size_t wrong = 0, all = 0, wrong_gland = 0, gland = 0;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (!s.region.contains(x) || x.y() > 90) continue;
        const double d = phantom.depth(x), w = phantom.before_wall(x);
        if (std::abs(d) < 2 || std::abs(w) < 2) continue;
        const bool breast = d > 0 && w > 0;
        wrong += label::is_breast(s.labels(i, j, k)) != breast;
        ++all;
        if (!breast || (x - phantom.gland).norm() > phantom.gland_radius - 2 ||
            (x - phantom.lesion).norm() < phantom.lesion_radius + 2)
          continue;
        wrong_gland += s.labels(i, j, k) != label::fibroglandular;
        ++gland;
      }
  // Nine voxels in ten thousand may be wrong: corners where skin meets the cut plane.
  EXPECT_LT(static_cast<double>(wrong), 0.003 * static_cast<double>(all));
  EXPECT_LT(static_cast<double>(wrong_gland), 0.02 * static_cast<double>(gland));

  for (std::size_t v = 0; v < s.labels.values.size(); ++v) {
    const Fractions& f = s.fractions.values[v];
    ASSERT_NEAR(f.fat + f.fibroglandular + f.lesion, label::is_breast(s.labels.values[v]), 1e-6);
  }
  EXPECT_NEAR(s.nipple_in_lps.x(), 75, 4);
  EXPECT_NEAR(s.nipple_in_lps.y(), -25, 2);
  EXPECT_NEAR(s.nipple_in_lps.z(), 0, 4);
  ASSERT_EQ(s.lesions.size(), 1U);
  EXPECT_LT((s.lesions[0].centroid_in_lps - phantom.lesion).norm(), 1);
  const double truth_ml = 4.0 / 3 * 3.14159 * std::pow(phantom.lesion_radius, 3) / 1000;
  EXPECT_NEAR(s.lesions[0].volume_ml, truth_ml, 0.3 * truth_ml);
}

INSTANTIATE_TEST_SUITE_P(Contrasts, SegmentMri, testing::Bool(), [](const auto& info) {
  return info.param ? "FatSuppressed" : "NotFatSuppressed";
});

TEST(SegmentOfAnMri, TakesABreastImagedAlone) {
  const EmptyFolder folder("alone");
  const Phantom phantom;
  const Volume<float> both = phantom.image();
  const int first = both.size.x() / 2 - 6;
  write_image(folder.path / "mri.nrrd",
              cropped(both, {first, 0, 0}, both.size - Eigen::Vector3i::Ones()));
  SegmentInput input = input_for(folder.path / "mri.nrrd", phantom);
  const SegmentResult result = segment(input, {});
  EXPECT_EQ(result.segmentation.region.side, Side::left);
  EXPECT_LT((result.segmentation.nipple_in_lps - Eigen::Vector3d(75, -25, 0)).norm(), 4);
  EXPECT_LT((result.segmentation.lesions.at(0).centroid_in_lps - phantom.lesion).norm(), 1);
  EXPECT_GE(result.segmentation.labels.origin.x(), both.position(first, 0, 0).x());
  EXPECT_FALSE(result.quality.volume_ratio) << "of a breast and its mirror image";

  input.side = Side::right;
  expect_mentions(message_of([&] { segment(input, {}); }),
                  {"shows the left breast alone", "expected the right one"});
}

TEST(SegmentOfAnMri, SegmentsARightBreastAsTheLeftOneThatItMirrors) {
  const EmptyFolder folder("mirrored");
  const Phantom phantom;
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  const SegmentResult left = segment(input, {});
  write_image(folder.path / "mirrored.nrrd", mirrored(phantom.image()));
  input.mri = folder.path / "mirrored.nrrd";
  input.lesions[0].point_in_lps = mirrored(*input.lesions[0].point_in_lps);
  const SegmentResult right = segment(input, {});
  EXPECT_EQ(right.segmentation.region.side, Side::right);
  const Segmentation back = mirrored(right.segmentation);
  EXPECT_EQ(back.labels.values, left.segmentation.labels.values);
  EXPECT_LT((back.labels.origin - left.segmentation.labels.origin).norm(), 1e-9);
  EXPECT_EQ(mirrored(right.image).values, left.image.values);
  EXPECT_LT((back.nipple_in_lps - left.segmentation.nipple_in_lps).norm(), 1e-9);
  EXPECT_LT(
      (back.lesions.at(0).centroid_in_lps - left.segmentation.lesions.at(0).centroid_in_lps).norm(),
      1e-9);
  ASSERT_EQ(right.quality.doubts.size(), left.quality.doubts.size());
  for (std::size_t n = 0; n < left.quality.doubts.size(); ++n) {
    ASSERT_EQ(right.quality.doubts[n].reason, left.quality.doubts[n].reason);
    if (!left.quality.doubts[n].place_in_lps) continue;
    const Eigen::Vector3d place = mirrored(*left.quality.doubts[n].place_in_lps);
    EXPECT_LT((*right.quality.doubts[n].place_in_lps - place).norm(), 1e-9);
    EXPECT_NE(right.quality.reasons[n].find(place_text(place)), std::string::npos);
  }
}

TEST(SegmentOfAnMri, RefusesALesionOutsideTheBreast) {
  const EmptyFolder folder("outside");
  const Phantom phantom{.voxel_mm = 3};
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.side = Side::left;
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(75, -45, 0), Eigen::Vector3d(75, 100, 0), Eigen::Vector3d(-88, 20, 18)}) {
    input.lesions[0].point_in_lps = x;
    expect_mentions(message_of([&] { segment(input, {}); }),
                    {"mri.nrrd", "lesion L1", "outside the left breast", "LPS"});
  }
  input.side = Side::right;
  input.lesions[0].point_in_lps = {-75, 100, 0};
  expect_mentions(message_of([&] { segment(input, {}); }),
                  {"lesion L1 at [-75.0, 100.0, 0.0]", "outside the right breast"});
}

TEST(SegmentOfAnMri, KeepsTwoLesionsThatAreOneBrightPatch) {
  const EmptyFolder folder("close");
  const Phantom phantom;
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom, {-3.4, 0, 0});
  input.lesions.push_back({"L2", phantom.lesion + Eigen::Vector3d(3.4, 0, 0), {}, {}, {}, {}});
  const SegmentResult result = segment(input, {});
  const std::vector<Lesion>& lesions = result.segmentation.lesions;
  ASSERT_EQ(lesions.size(), 2u);
  // Halves of a ball: each holds half of it, its centroid 3/8 of the radius off the middle.
  EXPECT_NEAR(lesions[0].volume_ml / lesions[1].volume_ml, 1, 0.15);
  for (int n = 0; n < 2; ++n)
    EXPECT_NEAR(lesions[n].centroid_in_lps.x() - phantom.lesion.x(),
                (n ? 3 : -3) * phantom.lesion_radius / 8, 1);
}

/// Points `forward` [mm] of the phantom's wall, at some heights.
fs::path drawn_before_the_wall(const fs::path& folder, const Phantom& phantom, double forward) {
  std::ofstream file(folder / "wall.mrk.json");
  file << R"({"markups":[{"coordinateSystem":"LPS","controlPoints":[)";
  const double radius = Phantom::chest_radius + forward;
  const char* comma = "";
  for (const double z : {-31, -1, 29})
    for (const double angle : {0.1, 0.3, 0.5, 0.7}) {
      file << comma << R"({"position":[)" << radius * std::sin(angle) << ","
           << phantom.chest_axis.y() - radius * std::cos(angle) << "," << z << "]}";
      comma = ",";
    }
  file << "]}]}";
  return folder / "wall.mrk.json";
}

TEST(SegmentOfAnMri, TakesTheWallThatAPersonDrewAndHoldsItBetweenSlices) {
  const EmptyFolder folder("drawn");
  const Phantom phantom;
  constexpr double forward = 8;  // where the image has no edge
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.wall_markups = drawn_before_the_wall(folder.path, phantom, forward);
  const SegmentResult result = segment(input, {});
  const Volume<std::uint8_t>& labels = result.segmentation.labels;
  for (const double z : {-31.0, -15.0, -1.0, 15.0, 29.0, 55.0})
    for (const double x : {31.0, 59.0, 91.0}) {
      const Eigen::Vector3i v = labels.index({x, labels.origin.y(), z}).array().round().cast<int>();
      int j = 0;
      while (j < labels.size.y() && labels(v.x(), j, v.z()) != label::muscle) ++j;
      ASSERT_LT(j, labels.size.y());
      const double before = phantom.before_wall(labels.position(v.x(), j, v.z()));
      EXPECT_NEAR(before, z < 50 ? forward : 0, 3) << "x " << x << ", z " << z;
    }
  const auto& notes = result.quality.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("drawn by hand, with 12 points") != std::string::npos;
  }));
}

TEST(SegmentOfAnMri, TakesTheRegionThatAPersonGave) {
  const EmptyFolder folder("roi");
  const Phantom phantom{.voxel_mm = 3};
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.region_markups = folder.path / "roi.mrk.json";
  std::ofstream(*input.region_markups)
      << R"({"markups":[{"type":"ROI","coordinateSystem":"LPS","center":[75,0,0],)"
      << R"("orientation":[1,0,0,0,1,0,0,0,1],"size":[110,200,130]}]})";
  const BreastRegion region = segment(input, {}).segmentation.region;
  EXPECT_NEAR(region.x_min, 20, 3);
  EXPECT_NEAR(region.x_max, 130, 3);
  EXPECT_NEAR(region.z_min, -65, 3);
  EXPECT_NEAR(region.z_max, 65, 3);
}

TEST(SegmentOfAnMri, RefusesAnUnclearSide) {
  const EmptyFolder folder("noside");
  const Phantom phantom{.voxel_mm = 3};
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.lesions.push_back({"L2", phantom.right_base, {}, {}, {}, {}});
  expect_mentions(message_of([&] { segment(input, {}); }), {"side is not clear", "patient.toml"});
}

TEST(SegmentOfAnMri, RefusesAnImageWithoutBreasts) {
  const EmptyFolder folder("flat");
  Phantom phantom{.voxel_mm = 3};
  phantom.semi_axes = {52, 5, 60};  // under the coat
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  expect_mentions(message_of([&] { segment(input, {}); }), {"mri.nrrd", "no breast found"});
}

TEST(SegmentOfAnMri, RefusesABreastCutInFront) {
  const EmptyFolder folder("cut");
  Phantom phantom{.voxel_mm = 3};
  phantom.semi_axes.y() = 120;  // the image begins 20 mm behind its tip
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  expect_mentions(message_of([&] { segment(input, {}); }), {"cut by the field of view in front"});
}

TEST(SegmentOfAnMri, IsTheSameTwiceAndTellsItsProgress) {
  const EmptyFolder folder("twice");
  const Phantom phantom{.voxel_mm = 3};
  const SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  std::vector<double> fractions;
  const SegmentResult a = segment(
      input, {}, [&](double fraction, const std::string&) { fractions.push_back(fraction); });
  const SegmentResult b = segment(input, {});
  EXPECT_EQ(a.segmentation.labels.values, b.segmentation.labels.values);
  EXPECT_EQ(a.image.values, b.image.values);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);
}

TEST(SegmentOfAnMri, ContrastCanBeGiven) {
  const EmptyFolder folder("given_contrast");
  const Phantom phantom;  // suppressed
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.fat_suppressed = false;
  EXPECT_EQ(segment(input, {}).quality.contrast, "not fat-suppressed");
}

/// Blurred over a voxel, half a voxel of skin hardly shows beside fat: muscle and gland decide.
TEST(SegmentOfAnMri, ContrastIsThatOfOtherTissueWhereSkinHardlyShows) {
  const EmptyFolder folder("thin_skin");
  const auto mentions = [](const SegmentResult& result) {
    const auto& reasons = result.quality.reasons;
    return std::any_of(reasons.begin(), reasons.end(), [](const std::string& reason) {
      return reason.find("mri.fat_suppressed") != std::string::npos;
    });
  };
  Phantom phantom;
  phantom.skin_mm = 0.8;
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  const SegmentResult agreed = segment(input, {});
  EXPECT_EQ(agreed.quality.contrast, "fat-suppressed");
  EXPECT_FALSE(mentions(agreed));
  phantom.fat_suppressed = false;  // its skin of 0.45 is blurred over a voxel to all but fat's
  input = input_for(write_phantom(folder.path, phantom), phantom);
  const SegmentResult doubted = segment(input, {});
  EXPECT_EQ(doubted.quality.contrast, "not fat-suppressed");
  EXPECT_TRUE(mentions(doubted));
  EXPECT_EQ(doubted.quality.status, SegmentStatus::look);
}

TEST(SegmentOfAnMri, NoiseThatTheScannerFilteredIsNotGland) {
  const EmptyFolder folder("filtered");
  Phantom phantom;
  phantom.noise = 0.4;  // 0.12 of fat once filtered, 0.04 between neighbours
  phantom.is_filtered = true;
  const Segmentation s =
      segment(input_for(write_phantom(folder.path, phantom), phantom), {}).segmentation;
  std::size_t fat = 0, called_gland = 0;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (!s.region.contains(x) || phantom.depth(x) < 6 || phantom.before_wall(x) < 4 ||
            (x - phantom.gland).norm() < phantom.gland_radius + 4 ||
            (x - phantom.lesion).norm() < phantom.lesion_radius + 4)
          continue;
        ++fat, called_gland += s.labels(i, j, k) == label::fibroglandular;
      }
  EXPECT_LT(static_cast<double>(called_gland), 0.001 * static_cast<double>(fat));
}

TEST(SegmentOfAnMri, NamesAnImageTurnedBackToFront) {
  const EmptyFolder folder("turned");
  const Phantom phantom;
  const Volume<float> right = phantom.image();
  Volume<float> turned = right;
  for (int k = 0; k < right.size.z(); ++k)
    for (int j = 0; j < right.size.y(); ++j)
      for (int i = 0; i < right.size.x(); ++i)
        turned(i, j, k) = right(i, right.size.y() - 1 - j, k);
  write_image(folder.path / "mri.nrrd", turned);
  SegmentInput input;
  input.mri = folder.path / "mri.nrrd";
  input.side = Side::left;
  expect_mentions(message_of([&] { segment(input, {}); }),
                  {"mri.nrrd", "towards the patient's back"});
}

}  // namespace
}  // namespace mammotwin
