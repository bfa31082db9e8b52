#include "pipeline/synthesize/slices_png.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mammotwin {
namespace {

using Eigen::Vector3i;

constexpr int zoom = 2, gap = 8;

/// A grey picture; rows from the top.
struct Canvas {
  int width, height;
  std::vector<std::uint8_t> pixels;
  Canvas(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, 0) {}
};

/// Puts the slice across `axis` at `left`: x or y to the right, z up or y down.
void draw(Canvas& canvas, int left, const Volume<std::int16_t>& image, const Vector3i& at, int axis,
          double white) {
  const int right = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
  const int width = zoom * image.size[right], height = zoom * image.size[down];
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      Vector3i v = at;
      v[right] = column / zoom;
      v[down] = down == 2 ? image.size.z() - 1 - row / zoom : row / zoom;
      const double grey = std::sqrt(std::clamp(image(v.x(), v.y(), v.z()) / white, 0.0, 1.0));
      canvas.pixels[static_cast<std::size_t>(row) * canvas.width + left + column] =
          static_cast<std::uint8_t>(std::lround(255 * grey));
    }
}

std::string big_endian(std::uint32_t n) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((n >> shift) & 255);
  return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

/// Rows, each after a byte that says "no filter", deflated.
std::string packed_rows(const Canvas& canvas) {
  std::string rows;
  for (int row = 0; row < canvas.height; ++row) {
    rows += '\0';
    rows.append(
        reinterpret_cast<const char*>(&canvas.pixels[static_cast<std::size_t>(row) * canvas.width]),
        canvas.width);
  }
  uLongf size = compressBound(rows.size());
  std::string packed(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(packed.data()), &size,
               reinterpret_cast<const Bytef*>(rows.data()), rows.size()) != Z_OK)
    throw std::runtime_error("zlib: cannot compress a picture");
  packed.resize(size);
  return packed;
}

std::string png(const Canvas& canvas) {
  const std::string grey_of_8_bit("\x08\0\0\0\0", 5);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(canvas.width) + big_endian(canvas.height) + grey_of_8_bit) +
         chunk("IDAT", packed_rows(canvas)) + chunk("IEND", "");
}

}  // namespace

void write_slices(const std::filesystem::path& path, const Volume<std::int16_t>& image,
                  const Eigen::Vector3d& point_in_lps, double white) {
  const Vector3i at = image.index(point_in_lps)
                          .array()
                          .round()
                          .cast<int>()
                          .matrix()
                          .cwiseMax(0)
                          .cwiseMin(image.size - Vector3i::Ones());
  const int axial = zoom * image.size.x(), sagittal = zoom * image.size.y();
  Canvas canvas(2 * axial + sagittal + 2 * gap, zoom * std::max(image.size.y(), image.size.z()));
  draw(canvas, 0, image, at, 2, white);
  draw(canvas, axial + gap, image, at, 1, white);
  draw(canvas, 2 * (axial + gap), image, at, 0, white);
  std::ofstream file(path, std::ios::binary);
  file << png(canvas);
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace mammotwin
