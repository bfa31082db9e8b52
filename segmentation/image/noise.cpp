#include "segmentation/image/noise.h"

#include <array>
#include <cmath>
#include <vector>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr int edge = 8;  // of the cubes of air [voxels]

/// Correlation of neighbours in the cube of air at `low`; none if there is anything else in it.
std::optional<double> correlation_in_cube(const Volume<float>& image,
                                          const Volume<std::uint8_t>& body,
                                          const Eigen::Vector3i& low) {
  std::array<std::array<std::array<double, edge>, edge>, edge> x{};
  double mean = 0;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i) {
        const std::size_t v = image.offset(low.x() + i, low.y() + j, low.z() + k);
        if (body.values[v] || !(image.values[v] > 0)) return std::nullopt;
        mean += x[k][j][i] = image.values[v];
      }
  mean /= edge * edge * edge;
  double square = 0, product = 0;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i) {
        const double here = x[k][j][i] - mean;
        square += here * here;
        if (i + 1 < edge) product += here * (x[k][j][i + 1] - mean);
        if (j + 1 < edge) product += here * (x[k][j + 1][i] - mean);
        if (k + 1 < edge) product += here * (x[k + 1][j][i] - mean);
      }
  if (square == 0) return std::nullopt;
  constexpr double pairs_per_voxel = 3 * (edge - 1.0) / edge;
  return product / (pairs_per_voxel * square);
}

}  // namespace

double noise_of_detail(const Volume<float>& image, const Volume<std::uint8_t>& where, int step) {
  constexpr double median_of_normal = 0.6745;  // of its absolute value
  std::vector<double> details;
  for (int k = 0; k + step < image.size.z(); k += 2)
    for (int j = 0; j + step < image.size.y(); j += 2)
      for (int i = 0; i + step < image.size.x(); i += 2) {
        double detail = 0;
        bool in = true;
        for (int c = 0; c < 8 && in; ++c) {
          const int a = i + step * (c & 1), b = j + step * ((c >> 1) & 1), d = k + step * (c >> 2);
          in = where(a, b, d);
          detail += ((c ^ (c >> 1) ^ (c >> 2)) & 1 ? -1 : 1) * static_cast<double>(image(a, b, d));
        }
        if (in) details.push_back(std::abs(detail) / std::sqrt(8.0));
      }
  return details.empty() ? 0 : median(details) / median_of_normal;
}

std::optional<double> noise_correlation(const Volume<float>& image,
                                        const Volume<std::uint8_t>& body) {
  constexpr std::size_t least_cubes = 50;
  std::vector<double> correlations;
  for (int k = 0; k + edge <= image.size.z(); k += edge)
    for (int j = 0; j + edge <= image.size.y(); j += edge)
      for (int i = 0; i + edge <= image.size.x(); i += edge)
        if (const auto c = correlation_in_cube(image, body, {i, j, k})) correlations.push_back(*c);
  if (correlations.size() < least_cubes) return std::nullopt;
  return median(correlations);
}

}  // namespace mammotwin
