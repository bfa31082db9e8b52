#include "segmentation/total_variation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

constexpr int rounds = 60;
constexpr float step = 0.28F;  // both steps: under 1 / |grad| = 1 / sqrt(12)
constexpr float heaviest =
    6;  // weight of a voxel over that of median noise: keeps the steps stable

float median_of_positive(const std::vector<float>& values) {
  std::vector<float> positive;
  for (const float v : values)
    if (v > 0) positive.push_back(v);
  if (positive.empty()) return 0;
  const auto middle = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 2);
  std::nth_element(positive.begin(), middle, positive.end());
  return *middle;
}

/// The problem in units of the median noise: weight (median / noise)^2, bound strength median^2 /
/// noise on the length of the dual field.
class PrimalDual {
 public:
  PrimalDual(const Volume<float>& image, const Volume<float>& noise, double strength)
      : size_(image.size),
        image_(image),
        u_(image),
        extrapolated_(image),
        weight_(image.like<float>(0)),
        bound_(image.like<float>(0)) {
    dual_.fill(image.like<float>(0));
    const float median = median_of_positive(noise.values);
    for (std::size_t v = 0; v < noise.values.size(); ++v) {
      const float ratio = noise.values[v] > 0 ? median / noise.values[v] : 0;
      weight_.values[v] = std::min(ratio * ratio, heaviest);
      bound_.values[v] = static_cast<float>(strength) * median * (ratio > 0 ? ratio : 1);
    }
  }

  Volume<float> solve() {
    for (int round = 0; round < rounds; ++round) {
      ascend();
      descend();
    }
    return std::move(u_);
  }

 private:
  /// dual = projection of dual + step grad(extrapolated) on the balls of the bounds.
  void ascend() {
    auto& [px, py, pz] = dual_;
    const Volume<float>& u = extrapolated_;
    tbb::parallel_for(0, size_.z(), [&](int k) {
      for (int j = 0; j < size_.y(); ++j)
        for (int i = 0; i < size_.x(); ++i) {
          const std::size_t v = u.offset(i, j, k);
          const float here = u.values[v];
          const auto raised = [&](const Volume<float>& p, bool inside, std::size_t next) {
            return inside ? p.values[v] + step * (u.values[next] - here) : 0.0F;
          };
          const float x = raised(px, i + 1 < size_.x(), v + 1);
          const float y = raised(py, j + 1 < size_.y(), v + size_.x());
          const float z =
              raised(pz, k + 1 < size_.z(), v + static_cast<std::size_t>(size_.x()) * size_.y());
          const float length = std::sqrt(x * x + y * y + z * z);
          const float scale = length > bound_.values[v] ? bound_.values[v] / length : 1.0F;
          px.values[v] = scale * x;
          py.values[v] = scale * y;
          pz.values[v] = scale * z;
        }
    });
  }

  /// u = the proximal point of u + step div(dual); extrapolated = 2 u - its last value.
  void descend() {
    const auto& [px, py, pz] = dual_;
    tbb::parallel_for(0, size_.z(), [&](int k) {
      const std::size_t slice = static_cast<std::size_t>(size_.x()) * size_.y();
      for (int j = 0; j < size_.y(); ++j)
        for (int i = 0; i < size_.x(); ++i) {
          const std::size_t v = u_.offset(i, j, k);
          float divergence = px.values[v] + py.values[v] + pz.values[v];
          if (i > 0) divergence -= px.values[v - 1];
          if (j > 0) divergence -= py.values[v - size_.x()];
          if (k > 0) divergence -= pz.values[v - slice];
          const float before = u_.values[v], weight = step * weight_.values[v];
          const float now = (before + step * divergence + weight * image_.values[v]) / (1 + weight);
          u_.values[v] = now;
          extrapolated_.values[v] = 2 * now - before;
        }
    });
  }

  Eigen::Vector3i size_;
  const Volume<float>& image_;
  Volume<float> u_, extrapolated_, weight_, bound_;
  std::array<Volume<float>, 3> dual_;
};

}  // namespace

Volume<float> total_variation_denoised(const Volume<float>& image, const Volume<float>& noise,
                                       double strength) {
  return PrimalDual(image, noise, strength).solve();
}

}  // namespace mammotwin
