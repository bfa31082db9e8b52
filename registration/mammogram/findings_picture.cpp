#include "registration/mammogram/findings_picture.h"

#include <algorithm>
#include <cmath>

#include "registration/mammogram/mammogram_masks.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

using Colour = ColourPicture::Colour;
constexpr Colour kGreen{60, 220, 60}, kYellow{230, 210, 40}, kRed{240, 70, 60}, kCyan{60, 220, 240},
    kOrange{255, 150, 30}, kMagenta{255, 60, 255};

/// Greys by their square root between the darkest and all but the brightest thousandth, so that
/// skin is seen.
ColourPicture grey_picture(const MammogramImage& image) {
  constexpr double kBright = 0.999;
  std::vector<float> greys = image.grey;
  const float dark = *std::min_element(greys.begin(), greys.end());
  const float range = std::max(1e-6f, quantile(greys, kBright) - dark);
  ColourPicture picture(image.columns, image.rows);
  for (std::size_t i = 0; i < image.grey.size(); ++i) {
    const float share = std::clamp((image.grey[i] - dark) / range, 0.f, 1.f);
    const auto grey = static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share)));
    picture.pixels[i] = {grey, grey, grey};
  }
  return picture;
}

void ring(ColourPicture& picture, const Eigen::Vector2d& centre, double radius, Colour colour) {
  constexpr int kPieces = 90;
  for (int n = 0; n < kPieces; ++n) {
    const double angle = 2 * M_PI * n / kPieces;
    picture.dot(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle),
                colour);
  }
}

}  // namespace

ColourPicture::ColourPicture(int columns, int rows, Colour colour)
    : columns(columns), rows(rows), pixels(static_cast<std::size_t>(columns) * rows, colour) {}

void ColourPicture::dot(double column, double row, Colour colour, int reach) {
  const int c = static_cast<int>(std::lround(column)), r = static_cast<int>(std::lround(row));
  for (int y = std::max(0, r - reach); y <= std::min(rows - 1, r + reach); ++y)
    for (int x = std::max(0, c - reach); x <= std::min(columns - 1, c + reach); ++x)
      pixels[static_cast<std::size_t>(y) * columns + x] = colour;
}

void ColourPicture::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour) {
  const int steps = static_cast<int>((to - from).norm()) + 1;
  for (int n = 0; n <= steps; ++n) {
    const Eigen::Vector2d x = from + (to - from) * (double(n) / steps);
    dot(x.x(), x.y(), colour);
  }
}

void ColourPicture::paste(const ColourPicture& other, int column, int row) {
  for (int y = 0; y < std::min(other.rows, rows - row); ++y)
    for (int x = 0; x < std::min(other.columns, columns - column); ++x)
      pixels[static_cast<std::size_t>(row + y) * columns + column + x] =
          other.pixels[static_cast<std::size_t>(y) * other.columns + x];
}

ColourPicture findings_picture(const MammogramImage& image, double pixel_mm,
                               const MammogramFindings& f, int height,
                               const std::vector<Eigen::Vector2d>& marks) {
  const int factor = std::max(1, (image.rows + height - 1) / height);
  ColourPicture picture = grey_picture(shrunk(image, factor));
  const auto at = [&](const Eigen::Vector2d& pixel) -> Eigen::Vector2d { return pixel / factor; };
  const auto curve = [&](const std::vector<Eigen::Vector2d>& points, Colour colour) {
    for (std::size_t n = 1; n < points.size(); ++n)
      picture.line(at(points[n - 1]), at(points[n]), colour);
  };
  curve(f.outline, kGreen);
  if (f.pectoral) picture.line(at(f.pectoral->first), at(f.pectoral->second), kYellow);
  curve(f.pectoral_curve, kRed);
  const bool unsure = std::count(f.unsure.begin(), f.unsure.end(), "nipple") > 0;
  for (const auto& candidate : f.nipples)
    picture.dot(at(candidate.pixel).x(), at(candidate.pixel).y(), kOrange, 1);
  if (f.nipple_sd_mm > 0)
    ring(picture, at(f.nipple), f.nipple_sd_mm / pixel_mm / factor, unsure ? kOrange : kCyan);
  for (const Eigen::Vector2d& mark : marks) picture.dot(at(mark).x(), at(mark).y(), kMagenta, 1);
  return picture;
}

}  // namespace mammotwin
