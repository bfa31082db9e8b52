#include "pipeline/report/mammogram_raster.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/report/palette.h"

namespace mammotwin {
namespace {

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
};

GreyRange range_of(std::vector<float> greys) {
  if (greys.empty()) return {};
  std::sort(greys.begin(), greys.end());
  const auto quantile = [&](double share) -> double {
    return greys[static_cast<std::size_t>(share * (greys.size() - 1))];
  };
  return {quantile(kDarkest), std::max(quantile(kBrightest), quantile(kDarkest) + 1e-6)};
}

}  // namespace

Raster mammogram_raster(const MammogramImage& image, const Detector& detector,
                        const Section& section, double pixel_mm) {
  std::vector<float> greys;
  section.sample(pixel_mm, [&](const Eigen::Vector3d& x) {
    if (const auto grey = grey_at(image, detector, x.head<2>())) greys.push_back(*grey);
    return Colour{};
  });
  const GreyRange range = range_of(std::move(greys));
  return section.sample(pixel_mm, [&](const Eigen::Vector3d& x) {
    const auto grey = grey_at(image, detector, x.head<2>());
    if (x.x() < 0 || !grey) return palette::grid;
    const double g = std::clamp((*grey - range.low) / (range.high - range.low), 0.0, 1.0);
    return Colour{g, g, g};
  });
}

}  // namespace mammotwin
