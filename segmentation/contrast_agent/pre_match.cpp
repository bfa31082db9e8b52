#include "segmentation/contrast_agent/pre_match.h"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "segmentation/image/order_statistics.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double part_mm = 24;
constexpr double told_to_mm = 0.25;
constexpr int border = 4;  // voxels in which smoothing sees the end of the image

double median_ratio(const Volume<float>& post, const Volume<float>& pre,
                    const Volume<std::uint8_t>& where) {
  std::vector<float> ratios;
  for (std::size_t v = 0; v < where.values.size(); ++v)
    if (where.values[v] && pre.values[v] > 0) ratios.push_back(post.values[v] / pre.values[v]);
  if (ratios.empty()) return 1;
  return median(ratios);
}

/// Normal equations of one part: displacement [mm] and relative change of brightness.
struct Part {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();

  void add(const Eigen::Vector4d& row, double difference, double weight) {
    matrix += weight * row * row.transpose();
    right += weight * difference * row;
  }

  /// Empty where the part does not tell it. Smoothing spreads white noise without changing what it
  /// does to sums over a smooth gradient, so the noise of the voxels counts.
  std::optional<double> shift_mm(double variance) const {
    const Eigen::Matrix3d moves = matrix.topLeftCorner<3, 3>();
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moves).eigenvalues()[0];
    if (least * told_to_mm * told_to_mm < variance) return std::nullopt;
    return matrix.ldlt().solve(right).head<3>().norm();
  }
};

Eigen::Vector3d gradient(const Volume<float>& image, int i, int j, int k) {
  return Eigen::Vector3d(image(i + 1, j, k) - image(i - 1, j, k),
                         image(i, j + 1, k) - image(i, j - 1, k),
                         image(i, j, k + 1) - image(i, j, k - 1))
      .cwiseQuotient(2 * image.spacing);
}

}  // namespace

bool PreMatch::moved() const { return shift_mm.value_or(0) > limits::pre_shift_mm; }

PreMatch match_pre(const Volume<float>& post, const Volume<float>& pre, const Volume<float>& noise,
                   const Volume<std::uint8_t>& where) {
  PreMatch match;
  match.scale = median_ratio(post, pre, where);
  const double smoothing_mm = post.spacing.maxCoeff();
  const Volume<float> after = gaussian_smoothed(post, smoothing_mm);
  const Volume<float> before = gaussian_smoothed(pre, smoothing_mm);
  const Eigen::Vector3i in_part = (part_mm / post.spacing.array()).ceil().cast<int>();
  const Eigen::Vector3i parts =
      (post.size + in_part - Eigen::Vector3i::Ones()).cwiseQuotient(in_part);
  std::vector<Part> all(static_cast<std::size_t>(parts.prod()));
  for (int k = border; k + border < post.size.z(); ++k)
    for (int j = border; j + border < post.size.y(); ++j)
      for (int i = border; i + border < post.size.x(); ++i) {
        const double sigma = noise(i, j, k);
        if (!where(i, j, k) || sigma <= 0) continue;
        Eigen::Vector4d row;
        row << (gradient(after, i, j, k) + match.scale * gradient(before, i, j, k)) / 2,
            before(i, j, k);
        const Eigen::Vector3i part = Eigen::Vector3i(i, j, k).cwiseQuotient(in_part);
        all[part.x() + parts.x() * (part.y() + static_cast<std::size_t>(parts.y()) * part.z())].add(
            row, after(i, j, k) - match.scale * before(i, j, k), 1 / (sigma * sigma));
      }
  std::vector<double> shifts;
  for (const Part& part : all)
    if (const auto shift = part.shift_mm(1 + match.scale * match.scale)) shifts.push_back(*shift);
  if (shifts.empty()) return match;
  const auto ninth = shifts.begin() + static_cast<std::ptrdiff_t>(shifts.size() * 9 / 10);
  std::nth_element(shifts.begin(), ninth, shifts.end());
  match.shift_mm = *ninth;
  return match;
}

Volume<float> mean_with_pre(Volume<float> post, const Volume<float>& pre, double scale) {
  const auto factor = static_cast<float>(scale);
  for (std::size_t v = 0; v < post.values.size(); ++v)
    post.values[v] = (post.values[v] + factor * pre.values[v]) / 2;
  return post;
}

}  // namespace mammotwin
