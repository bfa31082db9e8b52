#include "segmentation/files/inspect_nifti.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

namespace mammotwin {
namespace {

constexpr std::int32_t nifti1_header = 348, nifti2_header = 540;  // bytes, the standard's

struct Close {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

template <class T>
T value_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swapped) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

using NiftiHeader = std::array<char, nifti2_header>;

struct Layout {
  bool swapped = false, second_version = false;
  std::uintmax_t voxels_at = 0;  ///< byte where they begin
};

/// A place in a file; not before its begin, and where a file may still reach.
std::uintmax_t place_in_file(double byte) {
  constexpr double farthest = 1e15;  // a petabyte
  if (byte > farthest)
    throw std::runtime_error("its header says that voxels begin at byte " + std::to_string(byte) +
                             "; expected a place in the file (is the header damaged?)");
  return byte > 0 ? static_cast<std::uintmax_t>(byte) : 0;
}

Layout read_layout(gzFile_s* file, NiftiHeader& header) {
  const int got = gzread(file, header.data(), header.size());
  const auto is = [&](std::int32_t bytes, bool swapped) {
    return got >= bytes && value_at<std::int32_t>(header.data(), swapped) == bytes;
  };
  for (const bool swapped : {false, true}) {
    // vox_offset: a float at byte 108 of version 1, 64 bits at byte 168 of version 2
    if (is(nifti1_header, swapped))
      return {swapped, false, place_in_file(value_at<float>(header.data() + 108, swapped))};
    if (is(nifti2_header, swapped))
      return {
          swapped, true,
          place_in_file(static_cast<double>(value_at<std::int64_t>(header.data() + 168, swapped)))};
  }
  throw std::runtime_error("its header cannot be read; expected a NIfTI file");
}

/// `count` numbers from byte `at` on, floats in version 1 and doubles in version 2.
void check_numbers(const NiftiHeader& header, const Layout& layout, int at, int count,
                   const std::string& name) {
  constexpr double farthest_mm = 1e5;  // a hundred metres from the isocentre
  for (int n = 0; n < count; ++n) {
    const double value =
        layout.second_version
            ? value_at<double>(header.data() + at + n * sizeof(double), layout.swapped)
            : value_at<float>(header.data() + at + n * sizeof(float), layout.swapped);
    if (!(std::abs(value) <= farthest_mm))
      throw std::runtime_error("its " + name + " holds the number " + std::to_string(value) +
                               "; expected finite numbers of at most 100000 (is the header "
                               "damaged?)");
  }
}

/// Does a code say that the field counts?
bool field_counts(const NiftiHeader& header, const Layout& layout, int at) {
  return layout.second_version ? value_at<std::int32_t>(header.data() + at, layout.swapped) > 0
                               : value_at<std::int16_t>(header.data() + at, layout.swapped) > 0;
}

using NiftiFile = std::unique_ptr<gzFile_s, Close>;
NiftiFile open_nifti(const std::filesystem::path& path) {
  NiftiFile file(gzopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error("cannot be opened; expected a readable file");
  return file;
}

template <class T>
std::uintmax_t count_not_finite(const std::vector<char>& piece, std::size_t bytes, bool swapped) {
  std::uintmax_t count = 0;
  for (std::size_t n = 0; n + sizeof(T) <= bytes; n += sizeof(T))
    count += !std::isfinite(value_at<T>(piece.data() + n, swapped));
  return count;
}

}  // namespace

void check_nifti_placement(const std::filesystem::path& path) {
  NiftiHeader header{};
  const Layout layout = read_layout(open_nifti(path).get(), header);
  const bool v2 = layout.second_version;  // bytes of each field by the standards of both versions
  check_numbers(header, layout, v2 ? 104 : 76, 4, "pixdim");
  if (field_counts(header, layout, v2 ? 344 : 252))
    check_numbers(header, layout, v2 ? 352 : 256, 6, "qform");
  if (field_counts(header, layout, v2 ? 348 : 254))
    check_numbers(header, layout, v2 ? 400 : 280, 12, "sform");
}

NiftiVoxels inspect_nifti(const std::filesystem::path& path, int value_bytes, bool floating,
                          std::uintmax_t enough_bytes) {
  const NiftiFile file = open_nifti(path);
  NiftiHeader header{};
  const Layout layout = read_layout(file.get(), header);
  NiftiVoxels found;
  if (gzseek(file.get(), static_cast<z_off_t>(layout.voxels_at), SEEK_SET) < 0) return found;
  std::vector<char> piece(1 << 20);
  for (int got;
       found.bytes < enough_bytes &&
       (got = gzread(file.get(), piece.data(), static_cast<unsigned>(piece.size()))) > 0;) {
    found.bytes += static_cast<std::uintmax_t>(got);
    if (!floating) continue;
    found.not_finite += value_bytes == 8 ? count_not_finite<double>(piece, got, layout.swapped)
                                         : count_not_finite<float>(piece, got, layout.swapped);
  }
  return found;
}

}  // namespace mammotwin
