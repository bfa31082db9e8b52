#include "segmentation/files/scan_nifti.h"

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

struct Layout {
  bool swapped = false;
  std::uintmax_t voxels_at = 0;  ///< byte where they begin
};

Layout read_layout(gzFile_s* file) {
  std::array<char, nifti2_header> header{};
  const int got = gzread(file, header.data(), header.size());
  const auto is = [&](std::int32_t bytes, bool swapped) {
    return got >= 4 && value_at<std::int32_t>(header.data(), swapped) == bytes;
  };
  for (const bool swapped : {false, true}) {
    // vox_offset: a float at byte 108 of version 1, 64 bits at byte 168 of version 2
    if (is(nifti1_header, swapped))
      return {swapped, static_cast<std::uintmax_t>(
                           std::max(0.0F, value_at<float>(header.data() + 108, swapped)))};
    if (is(nifti2_header, swapped))
      return {swapped, static_cast<std::uintmax_t>(std::max<std::int64_t>(
                           0, value_at<std::int64_t>(header.data() + 168, swapped)))};
  }
  throw std::runtime_error("its header cannot be read; expected a NIfTI file");
}

template <class T>
std::uintmax_t count_not_finite(const std::vector<char>& piece, std::size_t bytes, bool swapped) {
  std::uintmax_t count = 0;
  for (std::size_t n = 0; n + sizeof(T) <= bytes; n += sizeof(T))
    count += !std::isfinite(value_at<T>(piece.data() + n, swapped));
  return count;
}

}  // namespace

NiftiVoxels scan_nifti(const std::filesystem::path& path, int value_bytes, bool floating,
                       std::uintmax_t enough_bytes) {
  const std::unique_ptr<gzFile_s, Close> file(gzopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error("cannot be opened; expected a readable file");
  const Layout layout = read_layout(file.get());
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
