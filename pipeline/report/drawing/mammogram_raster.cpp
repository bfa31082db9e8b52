#include "pipeline/report/drawing/mammogram_raster.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/report/drawing/jpeg.h"
#include "pipeline/report/drawing/palette.h"

namespace mammotwin {
namespace {

constexpr double kRange_mm = 0.5;  // between the pixels that black and white are found from
constexpr double kDarkest = 0.02, kBrightest = 0.998;

/// The pixel that a detector position falls on, or nothing.
std::optional<float> grey_at(const MammogramImage& image, const Detector& detector,
                             const Eigen::Vector2d& on_detector) {
  const Eigen::Vector2d at = detector.image_from_detector(on_detector);
  const int column = static_cast<int>(std::lround(at.x()));
  const int row = static_cast<int>(std::lround(at.y()));
  if (column < 0 || row < 0 || column >= image.columns || row >= image.rows) return std::nullopt;
  return image.at(column, row);
}

struct GreyRange {
  double low = 0, high = 1;

  double share(double grey) const { return std::clamp((grey - low) / (high - low), 0.0, 1.0); }
};

GreyRange range_of(std::vector<float> greys) {
  if (greys.empty()) return {};
  std::sort(greys.begin(), greys.end());
  const auto quantile = [&](double share) -> double {
    return greys[static_cast<std::size_t>(share * (greys.size() - 1))];
  };
  return {quantile(kDarkest), std::max(quantile(kBrightest), quantile(kDarkest) + 1e-6)};
}

GreyRange range_in(const MammogramImage& image, const Detector& detector, const Section& section,
                   double pixel_mm) {
  std::vector<float> greys;
  section.sample(pixel_mm, [&](const Eigen::Vector3d& x) {
    if (const auto grey = grey_at(image, detector, x.head<2>())) greys.push_back(*grey);
    return Colour{};
  });
  return range_of(std::move(greys));
}

}  // namespace

Raster mammogram_raster(const MammogramImage& image, const Detector& detector,
                        const Section& section, double pixel_mm) {
  const GreyRange range = range_in(image, detector, section, pixel_mm);
  return section.sample(pixel_mm, [&](const Eigen::Vector3d& x) {
    const auto grey = grey_at(image, detector, x.head<2>());
    if (x.x() < 0 || !grey) return palette::grid;
    const double g = range.share(*grey);
    return Colour{g, g, g};
  });
}

std::string native_mammogram(const MammogramImage& image, const Detector& detector,
                             const Section& section) {
  const GreyRange range = range_in(image, detector, section, kRange_mm);
  const double pixel_mm = detector.pixels->spacing_mm;
  const auto count = [&](double mm) { return std::max(1, static_cast<int>(mm / pixel_mm)); };
  const int columns = count(section.width_mm()), rows = count(section.height_mm());
  return grey_jpeg(columns, rows, [&](int row, std::uint8_t* values) {
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector3d x = section.in_space({(column + 0.5) * section.width_mm() / columns,
                                                  (row + 0.5) * section.height_mm() / rows});
      const auto grey = x.x() < 0 ? std::nullopt : grey_at(image, detector, x.head<2>());
      values[column] = static_cast<std::uint8_t>(
          std::lround(255 * (grey ? range.share(*grey) : palette::grid.red)));
    }
  });
}

}  // namespace mammotwin
