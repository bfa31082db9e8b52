// The scoring command on one breast of a real label map, in coarse voxels to be quick.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipeline/evaluate/cases/label_maps.h"
#include "pipeline/evaluate/segmentation/segmentation_row.h"
#include "pipeline/synthesize/map_patient.h"
#include "segmentation/files/read_labels.h"
#include "tests/segmentation/cases.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

TEST(EvaluateSegmentation, ScoresAnMriSimulatedFromARealMap) {
  MAMMOTWIN_NEED_CASE(maps, "label_maps");
  const EmptyFolder folder("evaluate");
  ScanOptions scan;
  scan.voxel_mm = 1.6;  // the contrast is read from the skin, which coarser voxels lose
  scan.shading = 1.2;
  const SegmentationCase c{"Exam_07-left", ScanContrast::fat_suppressed, [&] {
                             const auto map = read_labels(maps / "Exam_07_labels.nii.gz");
                             return make_map_patient(body_of_map(map, label_map_values(), 1),
                                                     Side::left, scan, 1);
                           }};
  const nlohmann::json row = segmentation_row(c, folder.path / "mri.nrrd");
  ASSERT_TRUE(row["reason"].is_null()) << row;
  EXPECT_EQ(row["found_contrast"], "fat-suppressed");
  EXPECT_GT(row["shading_ratio"], 4);
  // At 1.2 mm it reaches 0.99, 0 and 0.4 mm; a voxel is a third larger here.
  EXPECT_GT(row["breast_dice"], 0.95) << row;
  EXPECT_LE(row["chest_wall_median_mm"], 1.6) << row;
  EXPECT_LE(row["skin_surface_mean_mm"], 0.8) << row;
  EXPECT_TRUE(row["nipple_mm"].is_null()) << "a map does not say where it is";
}

}  // namespace
}  // namespace mammotwin
