#include "segmentation/mri/read_mri.h"

#include <fstream>
#include <limits>

#include "tests/segmentation/message.h"
#include "tests/segmentation/nifti_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

TEST(ReadMri, NiftiComesInLps) {
  const EmptyFolder folder("nifti");
  const Mri mri = read_mri(write_nifti(folder.path / "a.nii", 4, 5, 6, counting(120)));
  EXPECT_EQ(mri.image.size, Eigen::Vector3i(4, 5, 6));
  EXPECT_TRUE(mri.image.spacing.isApprox(Eigen::Vector3d(1, 1, 2)));
  EXPECT_TRUE(mri.image.origin.isApprox(Eigen::Vector3d(-10, -20, 30)));
  EXPECT_EQ(mri.image(1, 2, 3), 3 * 20 + 2 * 4 + 1);
}

TEST(ReadMri, MissingFileIsNamed) {
  expect_mentions(message_of([] { read_mri("/nowhere/mri.nii"); }),
                  {"/nowhere/mri.nii", "does not exist", "DICOM"});
}

TEST(ReadMri, EmptyFolderIsNamed) {
  const EmptyFolder folder("empty");
  expect_mentions(message_of([&] { read_mri(folder.path); }),
                  {folder.path.string(), "folder is empty", "DICOM"});
}

TEST(ReadMri, FolderWithoutImagesSaysSo) {
  const EmptyFolder folder("text");
  std::ofstream(folder.path / "notes.txt") << "not an image";
  expect_mentions(message_of([&] { read_mri(folder.path); }), {"no MR image", "1 file"});
}

TEST(ReadMri, TruncatedNiftiIsRefused) {
  const EmptyFolder folder("truncated");
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 6, counting(50));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "truncated", "480"});
}

TEST(ReadMri, TwoDimensionalImageIsRefused) {
  const EmptyFolder folder("flat");
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 1, counting(20));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "two-dimensional"});
}

TEST(ReadMri, NanIsRefused) {
  const EmptyFolder folder("nan");
  auto values = counting(120);
  values[7] = std::numeric_limits<float>::quiet_NaN();
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 6, values);
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "1 values", "NaN"});
}

TEST(ReadMri, HugeHeaderIsRefusedBeforeMemoryIsTaken) {
  const EmptyFolder folder("huge");
  const fs::path path = write_nifti(folder.path / "a.nii", 30000, 30000, 30000, counting(120));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "30000", "voxels"});
}

TEST(ReadMri, GarbageIsRefused) {
  const EmptyFolder folder("garbage");
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha", "a.dcm"}) {
    const fs::path path = folder.path / name;
    std::ofstream(path) << "this is no image at all, whatever its name says";
    expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "expected"});
  }
}

}  // namespace
}  // namespace mammotwin
