#include "segmentation/files/unpacked_size.h"

#include <zlib.h>

#include <fstream>
#include <stdexcept>
#include <vector>

namespace mammotwin {

std::uintmax_t unpacked_size(const std::filesystem::path& path, std::uintmax_t offset,
                             std::uintmax_t enough) {
  constexpr int zlib_or_gzip = 15 + 32;  // the largest window, and look which of both it is
  constexpr std::size_t piece = 1 << 20;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot be opened; expected a readable file");
  file.seekg(static_cast<std::streamoff>(offset));
  z_stream stream{};
  if (inflateInit2(&stream, zlib_or_gzip) != Z_OK) throw std::bad_alloc();
  std::vector<char> packed(piece), unpacked(piece);
  std::uintmax_t found = 0;
  int state = Z_OK;
  while (state == Z_OK && found < enough) {
    if (stream.avail_in == 0) {
      file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
      stream.next_in = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_in = static_cast<uInt>(file.gcount());
      if (stream.avail_in == 0) break;
    }
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
    stream.avail_out = static_cast<uInt>(unpacked.size());
    state = inflate(&stream, Z_NO_FLUSH);
    found += unpacked.size() - stream.avail_out;
  }
  inflateEnd(&stream);
  return found;
}

}  // namespace mammotwin
