#include "segmentation/mri/read_mri.h"
#include "tests/segmentation/cases.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

TEST(OddInputs, SeriesWithAGapNamesTheHole) {
  MAMMOTWIN_NEED_CASE(odd_inputs, "odd_inputs");
  const fs::path path = odd_inputs / "gap_series";
  // The positions in the headers: -80.9 (IM34) and 19.9 mm, 100.8 apart, one every 1.2 mm.
  expect_mentions(message_of([&] { read_mri(path); }),
                  {path.string(), "hole of 100.8 mm", "-80.9 mm", "19.9 mm", "every 1.2 mm"});
}

TEST(OddInputs, FramesThatAreNotParallelAreRefusedWithoutTheName) {
  MAMMOTWIN_NEED_CASE(odd_inputs, "odd_inputs");
  const std::string message = message_of([&] { read_mri(odd_inputs / "BRMULTI"); });
  expect_mentions(message, {"BRMULTI", "frame"});
}

TEST(OddInputs, EnhancedMultiframeIsRead) {
  MAMMOTWIN_NEED_CASE(odd_inputs, "odd_inputs");
  const Mri mri = read_mri(odd_inputs / "emri_small.dcm");
  EXPECT_EQ(mri.image.values.size(), 64U * 64 * 10);
}

TEST(OddInputs, OrdinarySeriesIsReadWhole) {
  MAMMOTWIN_NEED_CASE(mimbcd_6e4da81a, "mimbcd_6e4da81a");
  const Mri mri = read_mri(mimbcd_6e4da81a / "mri");
  EXPECT_EQ(mri.image.size, Eigen::Vector3i(352, 352, 176));
  EXPECT_NEAR(mri.image.spacing.z(), 1.2, 1e-4);
  EXPECT_EQ(mri.files.size(), 176U);
}

}  // namespace
}  // namespace mammotwin
