#include "registration/mammogram/detector_counts.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "registration/mammogram/breast_mask.h"
#include "registration/mammogram/mammogram_masks.h"

namespace mammotwin {
namespace {

constexpr int kStride = 8;  // of the pixels that are enough for statistics

float percentile(const MammogramImage& image, double share) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.grey.size(); i += kStride) values.push_back(image.grey[i]);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Median absolute deviation; of logarithms, since counts scatter with their size.
double spread(std::vector<float> values) {
  for (float& v : values) v = std::log(std::max(1.f, v));
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  const float median = *middle;
  for (float& v : values) v = std::abs(v - median);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Every stride-th pixel of every stride-th row.
MammogramImage sparse(const MammogramImage& image) {
  MammogramImage few{
      (image.columns + kStride - 1) / kStride, (image.rows + kStride - 1) / kStride, {}};
  for (int row = 0; row < image.rows; row += kStride)
    for (int column = 0; column < image.columns; column += kStride)
      few.grey.push_back(image.at(column, row));
  return few;
}

bool is_flat(const MammogramImage& image) {
  const auto [low, high] = std::minmax_element(image.grey.begin(), image.grey.end());
  return !(*high > *low);
}

/// Of the bands a tenth of the width from either side, air's varies less along the rows: the other
/// holds the breast, or its border. Air is what Otsu's threshold leaves that band on.
bool air_is_bright(const MammogramImage& image) {
  const MammogramImage few = sparse(image);
  if (is_flat(few)) return true;
  std::vector<float> left, right;
  for (int row = 0; row < few.rows; ++row)
    for (int i = few.columns / 10; i <= few.columns / 5; ++i) {
      left.push_back(few.at(i, row));
      right.push_back(few.at(few.columns - 1 - i, row));
    }
  std::vector<float>& air = spread(left) < spread(right) ? left : right;
  const auto middle = air.begin() + air.size() / 2;
  std::nth_element(air.begin(), middle, air.end());
  return *middle > otsu_threshold(few);
}

/// Takes out the plane through what is dark, twice: the second time without what the plane parts
/// from air.
void take_out_heel(MammogramImage& image) {
  for (int round = 0; round < 2; ++round) {
    const MammogramImage few = sparse(image);
    if (is_flat(few)) return;
    const float otsu = otsu_threshold(few);
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const auto place = [&](int column, int row) {
      return Eigen::Vector3d(1, double(column) / image.columns, double(row) / image.rows);
    };
    for (int row = 0; row < image.rows; row += kStride)
      for (int column = 0; column < image.columns; column += kStride) {
        if (image.at(column, row) > otsu) continue;
        const Eigen::Vector3d x = place(column, row);
        normal += x * x.transpose();
        right += x * image.at(column, row);
      }
    if (normal(0, 0) < 3) return;  // no plane without three pixels
    const Eigen::Vector3d plane = normal.ldlt().solve(right);
    for (int row = 0; row < image.rows; ++row)
      for (int column = 0; column < image.columns; ++column)
        image.at(column, row) -= static_cast<float>(plane.dot(place(column, row)));
  }
}

}  // namespace

void absorption_from_counts(MammogramImage& image, const CountsEncoding& encoding) {
  constexpr double kAir = 0.999, kNothing = 0.001;
  const float most = percentile(image, kAir), least = percentile(image, kNothing);
  const bool bright_air = encoding.brighter_is_more.value_or(air_is_bright(image));
  for (float& grey : image.grey) {
    const float counts =
        bright_air ? std::min(grey, most) : most + least - std::clamp(grey, least, most);
    grey = encoding.logarithmic ? most - counts
                                : std::log(std::max(1.f, most) / std::max(1.f, counts));
  }
  blacken_borders(image);  // what no X-rays reach is no tissue
  take_out_heel(image);
}

}  // namespace mammotwin
