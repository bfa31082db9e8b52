#include "segmentation/image/smoothing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

/// Replaces every line along one axis by `transform(line)`.
template <class Transform>
void along_axis(Volume<float>& image, int axis, const Transform& transform) {
  const Eigen::Vector3i n = image.size;
  const std::size_t step[3] = {1, static_cast<std::size_t>(n.x()),
                               static_cast<std::size_t>(n.x()) * n.y()};
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  tbb::parallel_for(0, n[c], [&](int w) {
    std::vector<float> line(n[axis]), out(n[axis]);
    for (int v = 0; v < n[b]; ++v) {
      float* first = image.values.data() + v * step[b] + w * step[c];
      for (int q = 0; q < n[axis]; ++q) line[q] = first[q * step[axis]];
      transform(line, out);
      for (int q = 0; q < n[axis]; ++q) first[q * step[axis]] = out[q];
    }
  });
}

std::vector<float> gaussian_weights(double sigma_voxels) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigma_voxels)));
  std::vector<float> weights(2 * reach + 1);
  double sum = 0;
  for (int q = -reach; q <= reach; ++q)
    sum += std::exp(-0.5 * q * q / (sigma_voxels * sigma_voxels));
  for (int q = -reach; q <= reach; ++q)
    weights[q + reach] =
        static_cast<float>(std::exp(-0.5 * q * q / (sigma_voxels * sigma_voxels)) / sum);
  return weights;
}

}  // namespace

Volume<float> gaussian_smoothed(Volume<float> image, double sigma) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float> weights = gaussian_weights(sigma / image.spacing[axis]);
    const int reach = static_cast<int>(weights.size()) / 2;
    along_axis(image, axis, [&](const std::vector<float>& line, std::vector<float>& out) {
      const int n = static_cast<int>(line.size());
      for (int q = 0; q < n; ++q) {
        const int low = std::max(0, q - reach), high = std::min(n - 1, q + reach);
        float sum = 0;
        for (int p = low; p <= high; ++p) sum += weights[p - q + reach] * line[p];
        out[q] = sum;
      }
    });
  }
  return image;
}

Volume<float> weighted_smoothed(const Volume<float>& image, const Volume<float>& weight,
                                double sigma) {
  Volume<float> product = image;
  for (std::size_t v = 0; v < product.values.size(); ++v) product.values[v] *= weight.values[v];
  product = gaussian_smoothed(std::move(product), sigma);
  const Volume<float> sum = gaussian_smoothed(weight, sigma);
  constexpr float least = 1e-6F;  // a weight of 1 at the cut of the kernel is about 1e-5 of it
  for (std::size_t v = 0; v < product.values.size(); ++v)
    product.values[v] = sum.values[v] > least ? product.values[v] / sum.values[v] : 0;
  return product;
}

Volume<float> local_maximum(Volume<float> image, int reach) {
  for (int axis = 0; axis < 3; ++axis)
    along_axis(image, axis, [&](const std::vector<float>& line, std::vector<float>& out) {
      const int n = static_cast<int>(line.size());
      for (int q = 0; q < n; ++q)
        out[q] = *std::max_element(line.begin() + std::max(0, q - reach),
                                   line.begin() + std::min(n, q + reach + 1));
    });
  return image;
}

float interpolated(const Volume<float>& image, const Eigen::Vector3d& x_in_lps) {
  const Eigen::Vector3d last = (image.size.array() - 1).cast<double>();
  const Eigen::Vector3d index = image.index(x_in_lps).cwiseMax(0).cwiseMin(last);
  const Eigen::Vector3i low =
      index.array().floor().cast<int>().min((image.size.array() - 2).max(0));
  const Eigen::Vector3f t = (index - low.cast<double>()).cast<float>();
  const int dx = image.size.x() > 1, dy = image.size.y() > 1, dz = image.size.z() > 1;
  const auto at = [&](int a, int b, int c) { return image(low.x() + a, low.y() + b, low.z() + c); };
  const auto mix = [](float a, float b, float s) { return a + s * (b - a); };
  const float front =
      mix(mix(at(0, 0, 0), at(dx, 0, 0), t.x()), mix(at(0, dy, 0), at(dx, dy, 0), t.x()), t.y());
  const float back = mix(mix(at(0, 0, dz), at(dx, 0, dz), t.x()),
                         mix(at(0, dy, dz), at(dx, dy, dz), t.x()), t.y());
  return mix(front, back, t.z());
}

Volume<float> block_means(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                          double block_mm, Volume<float>& share) {
  const Eigen::Vector3i factor =
      (block_mm / image.spacing.array()).round().max(1).cast<int>().matrix();
  const Eigen::Vector3i size =
      ((image.size.array() + factor.array() - 1) / factor.array()).matrix();
  const Eigen::Vector3d f = factor.cast<double>();
  const Eigen::Vector3d origin =
      image.origin + ((f.array() - 1) / 2 * image.spacing.array()).matrix();
  Volume<float> mean(size, image.spacing.cwiseProduct(f), origin, 0);
  share = mean;
  tbb::parallel_for(0, size.z(), [&](int c) {
    for (int b = 0; b < size.y(); ++b)
      for (int a = 0; a < size.x(); ++a) {
        float sum = 0, count = 0;
        for (int k = c * factor.z(); k < std::min(image.size.z(), (c + 1) * factor.z()); ++k)
          for (int j = b * factor.y(); j < std::min(image.size.y(), (b + 1) * factor.y()); ++j)
            for (int i = a * factor.x(); i < std::min(image.size.x(), (a + 1) * factor.x()); ++i)
              if (mask(i, j, k)) sum += image(i, j, k), ++count;
        share(a, b, c) = count / static_cast<float>(factor.prod());
        if (count > 0) mean(a, b, c) = sum / count;
      }
  });
  return mean;
}

Volume<float> smooth_field(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                           double block_mm, double sigma) {
  Volume<float> share;
  const Volume<float> mean = block_means(image, mask, block_mm, share);
  return weighted_smoothed(mean, share, sigma);
}

}  // namespace mammotwin
