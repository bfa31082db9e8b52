#include "segmentation/mri/read_mri.h"

#include <cstring>
#include <fstream>
#include <limits>

#include "segmentation/files/read_labels.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// A NIfTI-1 header of a float volume; RAS affine diag(-1, -1, 1) is LPS with identity axes.
std::string nifti_header(int nx, int ny, int nz) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t dims[8] = {3, std::int16_t(nx), std::int16_t(ny), std::int16_t(nz), 1, 1, 1,
                                1};
  std::memcpy(&h[40], dims, sizeof dims);
  put(70, std::int16_t{16});  // float
  put(72, std::int16_t{32});
  const float pixdim[8] = {1, 1, 1, 2, 1, 1, 1, 1};
  std::memcpy(&h[76], pixdim, sizeof pixdim);
  put(108, 352.0F);
  put(112, 1.0F);
  h[123] = 2;                 // mm
  put(254, std::int16_t{1});  // sform
  const float rows[12] = {-1, 0, 0, 10, 0, -1, 0, 20, 0, 0, 2, 30};
  std::memcpy(&h[280], rows, sizeof rows);
  std::memcpy(&h[344], "n+1", 4);
  return h;
}

fs::path write_nifti(const fs::path& path, int nx, int ny, int nz, std::vector<float> values) {
  std::ofstream file(path, std::ios::binary);
  file << nifti_header(nx, ny, nz);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(float)));
  return path;
}

std::vector<float> counting(std::size_t n) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(i);
  return values;
}

TEST(ReadImage, NiftiComesInLps) {
  const EmptyFolder folder("nifti");
  const Mri mri = read_mri(write_nifti(folder.path / "a.nii", 4, 5, 6, counting(120)));
  EXPECT_EQ(mri.image.size, Eigen::Vector3i(4, 5, 6));
  EXPECT_TRUE(mri.image.spacing.isApprox(Eigen::Vector3d(1, 1, 2)));
  EXPECT_TRUE(mri.image.origin.isApprox(Eigen::Vector3d(-10, -20, 30)));
  EXPECT_EQ(mri.image(1, 2, 3), 3 * 20 + 2 * 4 + 1);
}

TEST(ReadImage, MissingFileIsNamed) {
  expect_mentions(message_of([] { read_mri("/nowhere/mri.nii"); }),
                  {"/nowhere/mri.nii", "does not exist", "DICOM"});
}

TEST(ReadImage, EmptyFolderIsNamed) {
  const EmptyFolder folder("empty");
  expect_mentions(message_of([&] { read_mri(folder.path); }),
                  {folder.path.string(), "folder is empty", "DICOM"});
}

TEST(ReadImage, FolderWithoutImagesSaysSo) {
  const EmptyFolder folder("text");
  std::ofstream(folder.path / "notes.txt") << "not an image";
  expect_mentions(message_of([&] { read_mri(folder.path); }), {"no MR image", "1 file"});
}

TEST(ReadImage, TruncatedNiftiIsRefused) {
  const EmptyFolder folder("truncated");
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 6, counting(50));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "truncated", "480"});
}

TEST(ReadImage, TwoDimensionalImageIsRefused) {
  const EmptyFolder folder("flat");
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 1, counting(20));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "two-dimensional"});
}

TEST(ReadImage, NanIsRefused) {
  const EmptyFolder folder("nan");
  auto values = counting(120);
  values[7] = std::numeric_limits<float>::quiet_NaN();
  const fs::path path = write_nifti(folder.path / "a.nii", 4, 5, 6, values);
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "1 values", "NaN"});
}

TEST(ReadImage, HugeHeaderIsRefusedBeforeMemoryIsTaken) {
  const EmptyFolder folder("huge");
  const fs::path path = write_nifti(folder.path / "a.nii", 30000, 30000, 30000, counting(120));
  expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "30000", "voxels"});
}

TEST(ReadImage, GarbageIsRefused) {
  const EmptyFolder folder("garbage");
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha", "a.dcm"}) {
    const fs::path path = folder.path / name;
    std::ofstream(path) << "this is no image at all, whatever its name says";
    expect_mentions(message_of([&] { read_mri(path); }), {path.string(), "expected"});
  }
}

TEST(ReadImage, LabelsMustBeWholeNumbers) {
  const EmptyFolder folder("labels");
  auto values = counting(120);
  EXPECT_EQ(read_labels(write_nifti(folder.path / "a.nii", 4, 5, 6, values))(3, 4, 5), 119);
  values[3] = 0.5F;
  expect_mentions(
      message_of([&] { read_labels(write_nifti(folder.path / "b.nii", 4, 5, 6, values)); }),
      {"b.nii", "0.5", "whole"});
}

}  // namespace
}  // namespace mammotwin
