#include "segmentation/segmentation_file.h"

#include <fstream>
#include <sstream>

#include "tests/scratch_file.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

Segmentation small_segmentation() {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({12, 11, 10}, {1, 1.25, 2}, {-3.5, 7, 11}, label::air);
  s.fractions = s.labels.like<Fractions>();
  for (int k = 2; k < 8; ++k)
    for (int i = 2; i < 9; ++i) {
      s.labels(i, 2, k) = label::skin;
      for (int j = 3; j < 9; ++j) s.labels(i, j, k) = label::fat;
      s.labels(i, 9, k) = label::muscle;
    }
  s.labels(4, 5, 4) = label::lesion;
  s.fractions(4, 5, 4) = {0.25F, 0, 0.75F};
  s.fractions(5, 5, 4) = {0.125F, 0.875F, 0};
  s.region = {Side::right, -1.5, 5.5, 15, 27};
  s.nipple_in_lps = {0.1, 9.5, 20.3};
  s.lesions = {{"the big one", {0.5, 13.25, 19}, 0.0025}};
  return s;
}

TEST(SegmentationFile, ComesBackAsItWas) {
  const EmptyFolder folder("seg");
  const Segmentation s = small_segmentation();
  write_segmentation(folder.path / "a.seg.nrrd", s);
  write_fractions(folder.path / "f.nrrd", s.fractions);
  const Segmentation t = read_segmentation(folder.path / "a.seg.nrrd", folder.path / "f.nrrd");
  EXPECT_EQ(t.labels.values, s.labels.values);
  EXPECT_TRUE(t.labels.origin.isApprox(s.labels.origin));
  EXPECT_TRUE(t.labels.spacing.isApprox(s.labels.spacing));
  EXPECT_EQ(t.fractions(4, 5, 4).lesion, 0.75F);
  EXPECT_EQ(t.fractions(5, 5, 4).fibroglandular, 0.875F);
  EXPECT_EQ(t.region.side, Side::right);
  EXPECT_EQ(t.region.z_max, 27);
  EXPECT_EQ(t.nipple_in_lps, s.nipple_in_lps);
  ASSERT_EQ(t.lesions.size(), 1U);
  EXPECT_EQ(t.lesions[0].id, "the big one");
  EXPECT_EQ(t.lesions[0].centroid_in_lps, s.lesions[0].centroid_in_lps);
  EXPECT_EQ(t.lesions[0].volume_ml, 0.0025);
}

TEST(SegmentationFile, HeaderIsWhatSlicerReads) {
  const EmptyFolder folder("slicer");
  write_segmentation(folder.path / "a.seg.nrrd", small_segmentation());
  std::ifstream file(folder.path / "a.seg.nrrd", std::ios::binary);
  std::stringstream header;
  for (std::string line; std::getline(file, line) && !line.empty();) header << line << "\n";
  expect_mentions(header.str(),
                  {"space: left-posterior-superior", "Segment0_ID:=skin", "Segment0_LabelValue:=1",
                   "Segment0_Extent:=2 8 2 2 2 7", "Segment0_Layer:=0", "Segment1_Name:=fat",
                   "Segment3_Name:=the big one", "SCT^39937001^Skin"});
}

TEST(SegmentationFile, TwoRunsWriteTheSameBytes) {
  const EmptyFolder folder("bytes");
  for (const char* name : {"a.seg.nrrd", "b.seg.nrrd"})
    write_segmentation(folder.path / name, small_segmentation());
  const auto bytes = [&](const char* name) {
    std::ifstream file(folder.path / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.seg.nrrd"), bytes("b.seg.nrrd"));
}

// Read back as LPS, as every image is here; NIfTI's own coordinates are RAS and single precision.
TEST(SegmentationFile, NiftiHoldsTheSameVoxelsInTheSamePlace) {
  Volume<float> image({3, 4, 5}, {1.2, 0.9, 2}, {10, -20, 30.5});
  for (std::size_t v = 0; v < image.values.size(); ++v) image.values[v] = 0.5f * v;
  const auto path = scratch_file("place.nii.gz");
  write_nifti_image(path, image);
  const Volume<float> read = read_image_file(path);
  EXPECT_EQ(read.values, image.values);
  EXPECT_EQ(read.size, image.size);
  EXPECT_LT((read.origin - image.origin).norm(), 1e-5);
  EXPECT_LT((read.spacing - image.spacing).norm(), 1e-5);
}

TEST(SegmentationFile, GridsMustAgree) {
  const EmptyFolder folder("grids");
  Segmentation s = small_segmentation();
  write_segmentation(folder.path / "a.seg.nrrd", s);
  s.fractions.origin.x() += 1;
  write_fractions(folder.path / "f.nrrd", s.fractions);
  expect_mentions(
      message_of([&] { read_segmentation(folder.path / "a.seg.nrrd", folder.path / "f.nrrd"); }),
      {"f.nrrd", "grid"});
}

// patient.toml refuses such names; here they come from a file that somebody edited.
TEST(SegmentationFile, HostileNamesOfLesionsAreRefused) {
  const EmptyFolder folder("names");
  Segmentation s = small_segmentation();
  write_fractions(folder.path / "f.nrrd", s.fractions);
  for (const std::string id : {"=cmd|' /C calc'!A0", "\u202egnp.1L", "a\x1b[31m"}) {
    s.lesions = {{id, {1, 2, 3}, 0.5}};
    write_segmentation(folder.path / "a.seg.nrrd", s);
    expect_mentions(
        message_of([&] { read_segmentation(folder.path / "a.seg.nrrd", folder.path / "f.nrrd"); }),
        {"a.seg.nrrd", "mammotwin_lesion0", "expected a plain name"});
  }
}

TEST(SegmentationFile, AFolderThatIsNotThereIsNamed) {
  expect_mentions(
      message_of([] {
        write_image("/nowhere/a.nrrd", Volume<float>({2, 2, 2}, {1, 1, 1}, {0, 0, 0}, 1));
      }),
      {"/nowhere/a.nrrd", "cannot be written"});
}

}  // namespace
}  // namespace mammotwin
