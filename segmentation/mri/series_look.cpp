#include "segmentation/mri/series_look.h"

#include <algorithm>
#include <stdexcept>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/noise.h"
#include "segmentation/image/order_statistics.h"
#include "segmentation/mri/load_series.h"

namespace mammotwin {
namespace {

/// Median of an image between two depths below the skin; empty where there is little.
std::optional<double> median_at(const Volume<float>& image, const Volume<float>& depth, double from,
                                double to) {
  constexpr std::size_t least_voxels = 200;
  std::vector<float> values;
  for (std::size_t v = 0; v < image.values.size(); ++v)
    if (depth.values[v] >= from && depth.values[v] < to) values.push_back(image.values[v]);
  if (values.size() < least_voxels) return std::nullopt;
  return median(values);
}

/// As many slices as tell how it looks.
DicomSeries middle_of(DicomSeries series) {
  constexpr std::size_t enough = 40;
  const Eigen::Vector3d normal = series.slices.front().placement.normal();
  std::stable_sort(series.slices.begin(), series.slices.end(),
                   [&](const DicomSlice& a, const DicomSlice& b) {
                     return a.placement.position.dot(normal) < b.placement.position.dot(normal);
                   });
  if (series.slices.size() > enough) {
    const auto first = static_cast<std::ptrdiff_t>((series.slices.size() - enough) / 2);
    series.slices = {series.slices.begin() + first,
                     series.slices.begin() + first + static_cast<std::ptrdiff_t>(enough)};
  }
  return series;
}

}  // namespace

std::optional<SeriesLook> look_at_series(const Volume<float>& image) {
  constexpr double skin_from_mm = 0.5, skin_to_mm = 2, fat_from_mm = 5, fat_to_mm = 8.5;
  const Volume<std::uint8_t> body = coarse_body(image, estimate_noise(image));
  const Volume<float> depth = depth_below_surface(body);
  const auto skin = median_at(image, depth, skin_from_mm, skin_to_mm);
  const auto fat = median_at(image, depth, fat_from_mm, fat_to_mm);
  const double noise = noise_of_detail(image, body);
  if (!skin || !fat || !(*fat > 0) || !(noise > 0)) return std::nullopt;
  return SeriesLook{*fat / noise, *skin / *fat};
}

std::optional<SeriesLook> look_at_series(const DicomSeries& series) {
  try {
    std::vector<std::string> notes;
    const GridImage middle = load_series(middle_of(series));
    return look_at_series(to_lps_grid(middle, Between::linear, notes));
  } catch (const std::exception&) {
    return std::nullopt;  // whoever names it is told why
  }
}

}  // namespace mammotwin
