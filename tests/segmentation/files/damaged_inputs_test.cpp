// 200 damaged images: each gives a message or a result, never a crash or runaway memory.

#include <sys/resource.h>
#include <zlib.h>

#include <algorithm>
#include <optional>
#include <random>

#include "segmentation/mri/read_mri.h"
#include "segmentation/segment.h"
#include "segmentation/segmentation_file.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/segmentation/message.h"
#include "tests/segmentation/phantom.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string gzipped(const std::string& bytes) {
  z_stream z{};
  deflateInit2(&z, 1, Z_DEFLATED, 31, 9, Z_DEFAULT_STRATEGY);  // 31: with a gzip header
  std::string out(deflateBound(&z, bytes.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

/// The phantom at 5 mm: large enough to be a breast MRI, small enough for 200 of them.
Volume<float> small_phantom() {
  Phantom phantom;
  phantom.voxel_mm = 5;
  return phantom.image();
}

std::string float_bytes(const Volume<float>& image) {
  return {reinterpret_cast<const char*>(image.values.data()), 4 * image.values.size()};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

/// Text headers in front of raw or compressed voxels.
struct TextFormat {
  std::string name, header, voxels;
  std::string bytes() const { return header + voxels; }
};

TextFormat nrrd(const Volume<float>& v, bool compressed) {
  std::ostringstream h;
  h << "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: " << v.size.x()
    << " " << v.size.y() << " " << v.size.z()
    << "\nspace directions: (5,0,0) (0,5,0) (0,0,5)\nkinds: domain domain domain\nendian: little\n"
    << "encoding: " << (compressed ? "gzip" : "raw") << "\nspace origin: (" << v.origin.x() << ","
    << v.origin.y() << "," << v.origin.z() << ")\n\n";
  return {"a.nrrd", h.str(), compressed ? gzipped(float_bytes(v)) : float_bytes(v)};
}

TextFormat mha(const Volume<float>& v) {
  std::ostringstream h;
  h << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
    << "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = " << v.origin.x() << " " << v.origin.y()
    << " " << v.origin.z() << "\nElementSpacing = 5 5 5\nDimSize = " << v.size.x() << " "
    << v.size.y() << " " << v.size.z() << "\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
  return {"a.mha", h.str(), float_bytes(v)};
}

/// A NIfTI-1 header; the affine is that of an LPS grid with 5 mm voxels.
TextFormat nifti(const Volume<float>& v, bool compressed) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t dims[8] = {3,
                                static_cast<std::int16_t>(v.size.x()),
                                static_cast<std::int16_t>(v.size.y()),
                                static_cast<std::int16_t>(v.size.z()),
                                1,
                                1,
                                1,
                                1};
  std::memcpy(&h[40], dims, sizeof dims);
  put(70, std::int16_t{16});
  put(72, std::int16_t{32});
  const float pixdim[8] = {1, 5, 5, 5, 1, 1, 1, 1};
  std::memcpy(&h[76], pixdim, sizeof pixdim);
  put(108, 352.0F), put(112, 1.0F), put(254, std::int16_t{1});
  h[123] = 2;
  const float rows[12] = {-5, 0,  0, static_cast<float>(-v.origin.x()),
                          0,  -5, 0, static_cast<float>(-v.origin.y()),
                          0,  0,  5, static_cast<float>(v.origin.z())};
  std::memcpy(&h[280], rows, sizeof rows);
  std::memcpy(&h[344], "n+1", 4);
  if (!compressed) return {"a.nii", h, float_bytes(v)};
  return {"a.nii.gz", "", gzipped(h + float_bytes(v))};
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

class DamagedInputs : public testing::Test {
 protected:
  /// Anything but a crash: a message that names the path, or an image. Every tenth of those that
  /// can be read is segmented, too: a message, or a result with a status.
  void survive(const fs::path& path, const std::string& what) {
    ++count_;
    SegmentInput input;
    input.mri = path;
    input.side = Side::left;
    try {
      read_mri(path);
      if (++readable_ % 10 == 0) segment(input, {}), ++segmented_;
    } catch (const std::exception& error) {
      EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos)
          << what << ": " << error.what();
    }
  }
  void survive_bytes(const std::string& name, const std::string& bytes, const std::string& what) {
    write_bytes(folder_.path / name, bytes);
    survive(folder_.path / name, name + ", " + what);
  }
  /// Cut off in header and voxels, and with single bits turned over.
  void cut_and_flip(const std::string& name, const std::string& bytes, std::size_t header) {
    std::mt19937 random(11);
    const auto somewhere = [&](std::size_t below) { return random() % below; };
    for (int n = 0; n < 8; ++n) {
      const std::size_t size =
          n < 4 ? somewhere(header) : header + somewhere(bytes.size() - header);
      survive_bytes(name, bytes.substr(0, size), "cut to " + std::to_string(size));
    }
    for (int n = 0; n < 20; ++n) {
      std::string flipped = bytes;
      const std::size_t at = n < 16 ? somewhere(header) : somewhere(bytes.size());
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << somewhere(8)));
      survive_bytes(name, flipped, "bit turned in byte " + std::to_string(at));
    }
  }
  /// The message must mention the word.
  void refused(const std::string& name, const std::string& bytes, const std::string& word) {
    ++count_;
    write_bytes(folder_.path / name, bytes);
    SegmentInput input;
    input.mri = folder_.path / name;
    input.side = Side::left;
    expect_mentions(message_of([&] { segment(input, {}); }), {name, word});
  }

  EmptyFolder folder_{"damaged"};
  int count_ = 0, readable_ = 0, segmented_ = 0;
};

TEST_F(DamagedInputs, GiveAMessageOrAResultAndNoCrash) {
  const Volume<float> image = small_phantom();
  const double before_mb = peak_memory_mb();
  for (const TextFormat& f :
       {nifti(image, false), nrrd(image, false), nrrd(image, true), mha(image)})
    cut_and_flip(f.name, f.bytes(), std::max<std::size_t>(f.header.size(), 300));
  cut_and_flip("a.nii.gz", nifti(image, true).bytes(), 64);

  // Spacings, sizes and values that no scanner gives.
  const TextFormat plain = nrrd(image, false), meta = mha(image);
  const std::string sizes = "sizes: 64 34 36";
  for (const char* spacing : {"(0,0,0)", "(nan,0,0)", "(1e9,0,0)", "(1e-9,0,0)", "(500,0,0)"})
    refused("a.nrrd", replaced(plain.bytes(), "(5,0,0)", spacing), "a.nrrd");
  for (const char* spacing : {"0 0 0", "nan 5 5", "5 5 1e30"})
    refused("a.mha",
            replaced(meta.bytes(), "ElementSpacing = 5 5 5",
                     std::string("ElementSpacing = ") + spacing),
            "a.mha");
  for (const char* size : {"sizes: 64000 34000 36000", "sizes: 4294967296 4294967296 4294967296",
                           "sizes: 99999 99999 2", "sizes: -64 34 36", "sizes: 0 34 36"})
    refused("a.nrrd", replaced(plain.bytes(), sizes, size), "a.nrrd");
  for (const char* size : {"64000 34000 36000", "999999999 999999999 9", "-64 34 36", "0 0 0"})
    refused("a.mha", replaced(meta.bytes(), "DimSize = 64 34 36", std::string("DimSize = ") + size),
            "a.mha");
  auto strange = image;
  for (const float value : {NAN, INFINITY, -INFINITY}) {
    strange.values[1234] = value;
    refused("a.nrrd", nrrd(strange, true).bytes(), "not finite");
    refused("a.mha", mha(strange).bytes(), "not finite");
    refused("a.nii.gz", nifti(strange, true).bytes(), "not finite");
  }
  for (float& value : strange.values) value = -100;
  strange.values[5] = -101;
  survive_bytes("a.nrrd", nrrd(strange, true).bytes(), "negative everywhere");
  for (float& value : strange.values) value = 3e38F;
  strange.values[5] = 0;
  survive_bytes("a.nrrd", nrrd(strange, true).bytes(), "as large as numbers get");

  // Zip bombs: 100 MB of zeros in 400 KB behind a small header, and a header to match.
  const std::string zeros = gzipped(std::string(100'000'000, '\0'));
  survive_bytes("a.nrrd", nrrd(image, true).header + zeros, "more voxels than the header says");
  refused("a.nrrd", replaced(nrrd(image, true).header, sizes, "sizes: 4000 4000 4000") + zeros,
          "4000");
  survive_bytes("a.nii.gz", gzipped(nifti(image, false).header + std::string(100'000'000, '\0')),
                "more voxels than the header says");

  EXPECT_LT(peak_memory_mb() - before_mb, 1500);
  RecordProperty("images", count_);
  RecordProperty("readable", readable_);
  RecordProperty("segmented", segmented_);
}

/// Of a series with one damaged slice: what was read.
struct DamagedSeries {
  std::optional<Mri> mri;
  std::string message;  ///< where nothing was
};

DamagedSeries read_damaged(const fs::path& series) {
  try {
    return {read_mri(series), ""};
  } catch (const std::exception& error) {
    return {std::nullopt, error.what()};
  }
}

/// Do two images agree outside one slice?
bool agree_but_in(int slice, const Volume<float>& a, const Volume<float>& b) {
  if (a.size != b.size) return false;
  for (int k = 0; k < a.size.z(); ++k)
    for (int j = 0; j < a.size.y() && k != slice; ++j)
      for (int i = 0; i < a.size.x(); ++i)
        if (a(i, j, k) != b(i, j, k)) return false;
  return true;
}

class DamagedDicom : public DamagedInputs {
 protected:
  static constexpr int slice_ = 17;
  void SetUp() override {
    write_dicom_series(series_, "a", {}, small_phantom());
    sound_ = read_mri(series_).image;
    whole_ = bytes_of(victim_);
    header_ = whole_.size() - 2U * sound_.size.x() * sound_.size.y();
  }
  DamagedSeries read_with(const std::string& bytes) {
    write_bytes(victim_, bytes);
    return read_damaged(series_);
  }

  fs::path series_ = folder_.path / "series", victim_ = series_ / "a0017.dcm";
  Volume<float> sound_;
  std::string whole_;
  std::size_t header_ = 0;
  std::mt19937 random_{12};
};

/// A slice cut in its header is no image, and leaves a hole.
TEST_F(DamagedDicom, ASeriesWithASliceCutInItsHeaderIsRefused) {
  for (int n = 0; n < 5; ++n) {
    const std::size_t size = random_() % header_;
    const DamagedSeries found = read_with(whole_.substr(0, size));
    EXPECT_FALSE(found.mri) << "cut to " << size;
    expect_mentions(found.message, {"series", "expected"});
  }
}

/// GDCM fills in pixels that a file lacks and does not say so; other slices must stay.
TEST_F(DamagedDicom, ASliceCutInItsPixelsIsRefusedOrStaysTheOnlyOne) {
  for (int n = 0; n < 5; ++n) {
    const std::size_t size = header_ + random_() % (whole_.size() - header_);
    const DamagedSeries found = read_with(whole_.substr(0, size));
    if (found.mri)
      EXPECT_TRUE(agree_but_in(slice_, found.mri->image, sound_)) << "cut to " << size;
    else
      expect_mentions(found.message, {"series", "expected"});
  }
}

/// A bit turned in a header may go unseen, or take the slice out; it may not move other slices.
TEST_F(DamagedDicom, ABitTurnedInASliceIsRefusedOrStaysInThatSlice) {
  int unseen = 0, refused = 0;
  for (int n = 0; n < 30; ++n) {
    std::string bytes = whole_;
    const std::size_t at = 128 + random_() % (header_ - 128);  // 128: nothing reads the preamble
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << random_() % 8));
    const DamagedSeries found = read_with(bytes);
    if (!found.mri) {
      ++refused;
      expect_mentions(found.message, {"series", "expected"});
      continue;
    }
    ++unseen;
    EXPECT_TRUE(agree_but_in(slice_, found.mri->image, sound_)) << "bit turned in byte " << at;
  }
  // Most of a header is names and numbers that the image does not depend on, but not all of it.
  EXPECT_GT(unseen, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace mammotwin
