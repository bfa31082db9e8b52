// Files that end early, and headers over which a library would end the program or never end.

#include <sys/stat.h>

#include <cstring>
#include <limits>

#include "segmentation/files/detached_data.h"
#include "segmentation/files/dicom_pixel_length.h"
#include "segmentation/mri/read_mri.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr int kSide = 20;  // voxels an axis
constexpr std::size_t kVoxelBytes = 2 * kSide * kSide * kSide;

std::string voxels() {
  std::string bytes(kVoxelBytes, '\0');
  for (std::size_t n = 0; n < bytes.size(); n += 2) bytes[n] = static_cast<char>(n / 2 % 101);
  return bytes;
}

std::string meta_header(const std::string& dimensions, const std::string& data_file) {
  return "ObjectType = Image\nNDims = " + dimensions +
         "\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = 0 0 0\n"
         "ElementSpacing = 2 2 2\nDimSize = 20 20 20\nElementType = MET_SHORT\n"
         "ElementDataFile = " +
         data_file + "\n";
}

struct ShortFiles : testing::Test {
  EmptyFolder folder{"short"};
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder.path / name, std::ios::binary) << bytes;
    return folder.path / name;
  }
  void expect_refused(const fs::path& path, std::initializer_list<std::string> words) const {
    const std::string message = message_of([&] { read_mri(path); });
    expect_mentions(message, {path.filename().string()});
    expect_mentions(message, words);
  }
};

TEST_F(ShortFiles, AMetaImageThatEndsEarlyIsRefusedAndAWholeOneRead) {
  const std::string header = meta_header("3", "LOCAL"), whole = header + voxels();
  EXPECT_EQ(read_mri(write("a.mha", whole)).image(3, 0, 0), 3);
  expect_refused(write("a.mha", whole.substr(0, whole.size() * 3 / 4)),
                 {"is truncated", "expected 16000"});
  expect_refused(write("a.mha", whole.substr(0, whole.size() - 1)), {"is truncated"});
}

TEST_F(ShortFiles, ADetachedDataFileThatEndsEarlyIsRefused) {
  const auto header = write("a.mhd", meta_header("3", "a.raw"));
  const auto data = write("a.raw", voxels());
  EXPECT_EQ(detached_data_file(header), data);
  EXPECT_EQ(read_mri(header).image(3, 0, 0), 3);
  write("a.raw", voxels().substr(0, kVoxelBytes / 2));
  expect_refused(header, {"is truncated: 8000 bytes"});
  fs::remove(data);
  expect_mentions(message_of([&] { detached_data_file(header); }), {"a.mhd", "header and data"});
}

TEST_F(ShortFiles, ANrrdHeaderNamesItsDataFile) {
  const std::string header = "NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\n";
  write("a.raw", voxels());
  EXPECT_EQ(detached_data_file(write("a.nhdr", header + "data file: a.raw\n")),
            folder.path / "a.raw");
  EXPECT_FALSE(detached_data_file(write("a.nrrd", header + "\ndata file: a.raw\n")));
  expect_mentions(
      message_of([&] { detached_data_file(write("b.nhdr", header + "data file: LIST\n")); }),
      {"b.nhdr", "several files"});
}

TEST_F(ShortFiles, DimensionsThatAreNoCountsAreRefusedBeforeTheLibrarySeesThem) {
  for (const char* dimensions : {"-1", "0", "11", "3e9", ""})
    expect_refused(write("a.mha", meta_header(dimensions, "LOCAL") + voxels()), {"NDims"});
  expect_refused(write("a.mha", meta_header("2", "LOCAL") + voxels()), {"DimSize has 3 numbers"});
}

TEST_F(ShortFiles, ANrrdCutInItsHeaderIsRefused) {
  const std::string header =
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 20 20\n"
      "space directions: (2,0,0) (0,2,0) (0,0,2)\nkinds: domain domain domain\nendian: little\n"
      "encoding: raw\nspace origin: (0,0,0)\n\n";
  EXPECT_EQ(read_mri(write("a.nrrd", header + voxels())).image(3, 0, 0), 3);
  for (std::size_t size = 1; size < header.size(); size += 7)
    expect_refused(write("a.nrrd", header.substr(0, size)), {});
}

/// NIfTI-1 with an sform; every number at its byte of the standard.
std::string nifti(float corner) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t sizes[] = {3, kSide, kSide, kSide, 1, 1, 1, 1};
  std::memcpy(&h[40], sizes, sizeof sizes);
  put(70, std::int16_t{4});   // signed short
  put(72, std::int16_t{16});  // bits
  const float steps[] = {1, 2, 2, 2, 0, 0, 0, 0};
  std::memcpy(&h[76], steps, sizeof steps);
  put(108, 352.0F);
  put(112, 1.0F);
  h[123] = 2;  // mm
  put(254, std::int16_t{1});
  const float rows[] = {2, 0, 0, corner, 0, 2, 0, 0, 0, 0, 2, 0};
  std::memcpy(&h[280], rows, sizeof rows);
  std::memcpy(&h[344], "n+1", 4);
  return h + voxels();
}

TEST_F(ShortFiles, ANiftiWhosePlaceIsNotFiniteIsRefused) {
  EXPECT_EQ(read_mri(write("a.nii", nifti(0))).image.values.size(), kVoxelBytes / 2);
  for (const float corner :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F})
    expect_refused(write("a.nii", nifti(corner)), {"sform", "expected finite"});
}

TEST_F(ShortFiles, ADicomSliceThatLacksAByteIsRefused) {
  const std::vector<std::uint16_t> pixels(64, 7);
  const std::string whole = dicom_slice_bytes({}, 0, 8, 8, {0, 0, 0}, 2, pixels);
  check_pixels_whole(write("a.dcm", whole), 128);
  check_pixels_whole(write("a.dcm", whole + "behind"), 128);
  for (const std::size_t missing : {1, 2, 64, 127})
    expect_mentions(message_of([&] {
                      check_pixels_whole(write("a.dcm", whole.substr(0, whole.size() - missing)),
                                         128);
                    }),
                    {"is truncated", "expected 128"});
}

TEST_F(ShortFiles, ASeriesWithAShortSliceIsRefused) {
  Volume<float> image({8, 8, 20}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 5);
  image(3, 3, 3) = 7;
  write_dicom_series(folder.path / "mri", "a", {}, image);
  EXPECT_EQ(read_mri(folder.path / "mri").image(3, 3, 3), 7);
  const fs::path slice = folder.path / "mri" / "a0009.dcm";
  ASSERT_TRUE(fs::exists(slice));
  fs::resize_file(slice, fs::file_size(slice) - 70);
  expect_mentions(message_of([&] { read_mri(folder.path / "mri"); }), {"a0009.dcm", "truncated"});
}

TEST_F(ShortFiles, NoTextOfAHeaderAndNoFileNameIsInTheNotes) {
  Volume<float> image({8, 8, 20}, Eigen::Vector3d::Constant(2), {0, 0, 0}, 5);
  image(3, 3, 3) = 7;
  DicomHeader h;
  h.description = "M\xfcller, Anna";
  for (const char* number : {"4", "19510203"}) {
    h.series_number = number, h.series_uid = std::string("1.2.") + number;
    write_dicom_series(folder.path / "mri", std::string("Mueller_Anna_") + number, h, image);
  }
  const Mri mri = read_mri(folder.path / "mri");
  ASSERT_FALSE(mri.notes.empty());
  for (const std::string& note : mri.notes)
    for (const char* part : {"ller", "Anna", "19510203"})
      EXPECT_EQ(note.find(part), std::string::npos) << note;
}

TEST_F(ShortFiles, APipeIsNoImage) {
  ASSERT_EQ(mkfifo((folder.path / "a.mha").c_str(), 0600), 0);
  expect_refused(folder.path / "a.mha", {"expected a folder"});
}

}  // namespace
}  // namespace mammotwin
