#include "segmentation/images_beside.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/segmentation/files/dicom_writer.h"
#include "tests/segmentation/message.h"
#include "tests/segmentation/phantom_input.h"

namespace mammotwin {
namespace {

/// What fills with contrast agent behind the chest wall: a ball of 30 mm, three times as bright.
void add_heart(Volume<float>& image) {
  const Eigen::Vector3d middle = Phantom().chest_axis - Eigen::Vector3d(0, 90, 0);
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        if ((image.position(i, j, k) - middle).norm() < 30) image(i, j, k) *= 3;
}

/// Not suppressed, after contrast agent: the lesion is as bright as fat, and is seen only against
/// the image before.
TEST(ImagesBeside, TheOneBeforeContrastAgentShowsTheLesion) {
  const EmptyFolder folder("dynamic");
  Phantom phantom;
  phantom.fat_suppressed = false;
  write_image(folder.path / "pre.nrrd", phantom.image());
  phantom.contrast_agent = true;
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.pre = folder.path / "pre.nrrd";
  const SegmentResult result = segment(input, {});
  const Lesion& lesion = result.segmentation.lesions.at(0);
  EXPECT_LT((lesion.centroid_in_lps - phantom.lesion).norm(), 1);
  const double truth_ml = 4.0 / 3 * 3.14159 * std::pow(phantom.lesion_radius, 3) / 1000;
  EXPECT_NEAR(lesion.volume_ml, truth_ml, 0.3 * truth_ml);
  ASSERT_EQ(result.quality.candidates.size(), 1U);
  EXPECT_LT((result.quality.candidates[0].centroid_in_lps - phantom.lesion).norm(), 1);
  // (0.95 - 0.42) / 0.42 = 1.26 inside; its edge, where the mean over a voxel is less, counts too.
  EXPECT_NEAR(result.quality.candidates[0].enhancement, 1.26, 0.15);
}

/// Three phases in one folder: the second is read, the first beside it where an agent came between.
TEST(ImagesBeside, ThePhaseBeforeOfADynamicStudyIsUsedWhereItShowsUptake) {
  Phantom phantom;
  phantom.fat_suppressed = false;
  const auto segmented = [&](bool agent) {
    const EmptyFolder folder(agent ? "phases" : "repeats");
    for (int phase = 1; phase <= 3; ++phase) {
      phantom.contrast_agent = agent && phase > 1;
      DicomHeader header;
      header.series_number = std::to_string(phase),
      header.series_uid = "1.2." + header.series_number;
      header.acquisition_time = "10101" + header.series_number;
      Volume<float> image = phantom.image();
      if (phantom.contrast_agent) add_heart(image);
      write_dicom_series(folder.path / "mri", header.series_number, header, image);
    }
    return segment(input_for(folder.path / "mri", phantom), {});
  };
  const SegmentResult with = segmented(true), without = segmented(false);
  EXPECT_LT((with.segmentation.lesions.at(0).centroid_in_lps - phantom.lesion).norm(), 1);
  EXPECT_EQ(with.quality.candidates.size(), 1U);
  EXPECT_TRUE(without.quality.candidates.empty());
  const auto notes = [](const SegmentResult& result) {
    std::string all;
    for (const std::string& note : result.quality.notes) all += note + "\n";
    return all;
  };
  expect_mentions(notes(with), {"enhancement over the image before"});
  expect_mentions(notes(without), {"no uptake of contrast agent"});
}

TEST(ImagesBeside, OneBeforeContrastAgentOfAnotherPlaceIsRefused) {
  const EmptyFolder folder("elsewhere");
  Phantom phantom;
  Volume<float> pre = phantom.image();
  pre.origin.z() += 60;
  write_image(folder.path / "pre.nrrd", pre);
  SegmentInput input = input_for(write_phantom(folder.path, phantom), phantom);
  input.pre = folder.path / "pre.nrrd";
  expect_mentions(message_of([&] { segment(input, {}); }),
                  {"before contrast agent covers", "90 %"});
}

/// Two series without a dynamic study: the second in time is read, the other's wall lies elsewhere.
TEST(ImagesBeside, TheWallIsComparedWithThatOfAnotherSeries) {
  const EmptyFolder folder("study");
  Phantom phantom;
  DicomHeader header;
  header.series_number = "9", header.series_uid = "1.2.9", header.acquisition_time = "101010";
  write_dicom_series(folder.path / "mri", "a", header, phantom.image());
  const SegmentInput input = input_for(folder.path / "mri", phantom);
  EXPECT_FALSE(segment(input, {}).quality.chest_wall_unlike_compared);
  phantom.fat_suppressed = false;
  Volume<float> moved = phantom.image();
  moved.origin.y() += 8;
  header.series_number = "4", header.series_uid = "1.2.4", header.acquisition_time = "101005";
  write_dicom_series(folder.path / "mri", "b", header, moved);
  const SegmentResult result = segment(input, {});
  EXPECT_GT(*result.quality.chest_wall_unlike_compared, 0.9);
  EXPECT_EQ(result.quality.status, SegmentStatus::look);
  EXPECT_EQ(result.files.size(), 2U * moved.size.z()) << "both are inputs";
  ASSERT_FALSE(result.quality.reasons.empty());
  expect_mentions(result.quality.reasons[0], {"chest wall", "8 mm deeper", "series 4"});
}

}  // namespace
}  // namespace mammotwin
