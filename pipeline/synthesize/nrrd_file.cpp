#include "pipeline/synthesize/nrrd_file.h"

#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr int gzip_window = 15 + 16;  // zlib: the largest window, with a gzip header

/// gzip without a name or a time in its header.
std::string gzip(const void* data, std::size_t bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, 9,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib: cannot start to compress");
  std::string out(deflateBound(&stream, bytes), '\0');
  stream.next_in = static_cast<Bytef*>(const_cast<void*>(data));
  stream.avail_in = static_cast<uInt>(bytes);
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status =
      bytes <= std::numeric_limits<uInt>::max() ? deflate(&stream, Z_FINISH) : Z_BUF_ERROR;
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END)
    throw std::runtime_error("zlib: cannot compress an image of this size");
  return out;
}

template <class T>
std::string header(const Volume<T>& v, const char* type) {
  std::ostringstream h;
  h.precision(17);
  h << "NRRD0004\ntype: " << type
    << "\ndimension: 3\nspace: left-posterior-superior\nsizes: " << v.size.transpose()
    << "\nspace directions: (" << v.spacing.x() << ",0,0) (0," << v.spacing.y() << ",0) (0,0,"
    << v.spacing.z() << ")\nkinds: domain domain domain\nendian: little\n"
    << "encoding: gzip\nspace origin: (" << v.origin.x() << "," << v.origin.y() << ","
    << v.origin.z() << ")\n\n";
  return h.str();
}

template <class T>
void write(const std::filesystem::path& path, const Volume<T>& v, const char* type) {
  std::ofstream file(path, std::ios::binary);
  file << header(v, type) << gzip(v.values.data(), v.values.size() * sizeof(T));
  file.close();
  if (!file)
    throw std::runtime_error(path.string() + ": cannot be written (" + std::strerror(errno) + ")");
}

}  // namespace

void write_nrrd(const std::filesystem::path& path, const Volume<std::int16_t>& image) {
  write(path, image, "int16");
}

void write_nrrd(const std::filesystem::path& path, const Volume<std::uint8_t>& labels) {
  write(path, labels, "uint8");
}

}  // namespace mammotwin
