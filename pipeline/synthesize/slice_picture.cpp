#include "pipeline/synthesize/slice_picture.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

using Eigen::Vector3i;

constexpr int zoom = 2, gap = 8;

/// Puts the slice across `axis` at `left`: x or y to the right, z up or y down.
void draw(GreyPixels& picture, int left, const Volume<std::int16_t>& image, const Vector3i& at,
          int axis, double white) {
  const int right = axis == 0 ? 1 : 0, down = axis == 2 ? 1 : 2;
  const int width = zoom * image.size[right], height = zoom * image.size[down];
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      Vector3i v = at;
      v[right] = column / zoom;
      v[down] = down == 2 ? image.size.z() - 1 - row / zoom : row / zoom;
      const double grey = std::sqrt(std::clamp(image(v.x(), v.y(), v.z()) / white, 0.0, 1.0));
      picture.grey[static_cast<std::size_t>(row) * picture.columns + left + column] =
          static_cast<std::uint16_t>(std::lround(65535 * grey));
    }
}

}  // namespace

GreyPixels slice_picture(const Volume<std::int16_t>& image, const Eigen::Vector3d& point_in_lps,
                         double white) {
  const Vector3i at = image.index(point_in_lps)
                          .array()
                          .round()
                          .cast<int>()
                          .matrix()
                          .cwiseMax(0)
                          .cwiseMin(image.size - Vector3i::Ones());
  const int axial = zoom * image.size.x(), sagittal = zoom * image.size.y();
  GreyPixels picture{
      2 * axial + sagittal + 2 * gap, zoom * std::max(image.size.y(), image.size.z()), {}};
  picture.grey.assign(static_cast<std::size_t>(picture.columns) * picture.rows, 0);
  draw(picture, 0, image, at, 2, white);
  draw(picture, axial + gap, image, at, 1, white);
  draw(picture, 2 * (axial + gap), image, at, 0, white);
  return picture;
}

}  // namespace mammotwin
