#include "segmentation/image/total_variation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr int rounds = 80;
constexpr float dual_step = 0.7F;
// Weight of a voxel over that of median noise: a few quiet ones would make the steps small.
constexpr float heaviest = 6;

float median_of_positive(const std::vector<float>& values) {
  std::vector<float> positive;
  for (const float v : values)
    if (v > 0) positive.push_back(v);
  if (positive.empty()) return 0;
  return median(positive);
}

/// Mean of the image where its noise is known.
float mean_of_known(const Volume<float>& image, const Volume<float>& noise) {
  double sum = 0, count = 0;
  for (std::size_t v = 0; v < image.values.size(); ++v)
    if (noise.values[v] > 0) sum += image.values[v], ++count;
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

/// Convolved along one axis with (side, 1 - 2 side, side); what lies beyond is like the border.
void blur_along(int axis, float side, const Volume<float>& in, Volume<float>& out) {
  const Eigen::Vector3i size = in.size;
  const std::ptrdiff_t stride = axis == 0   ? 1
                                : axis == 1 ? size.x()
                                            : static_cast<std::ptrdiff_t>(size.x()) * size.y();
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const int at = axis == 0 ? i : axis == 1 ? j : k;
        const float* here = &in.values[in.offset(i, j, k)];
        const float before = at > 0 ? here[-stride] : *here;
        const float after = at + 1 < size[axis] ? here[stride] : *here;
        out.values[in.offset(i, j, k)] = *here + side * (before - 2 * *here + after);
      }
  });
}

/// The problem in units of the median noise: weight (median / noise)^2, bound strength median^2 /
/// noise on the length of the dual field.
class PrimalDual {
 public:
  PrimalDual(const Volume<float>& image, const Volume<float>& noise, double strength, double blur)
      : size_(image.size),
        side_(static_cast<float>(blur * blur / 2)),
        image_(image),
        u_(image),
        extrapolated_(image),
        weight_(image.like<float>(0)),
        bound_(image.like<float>(0)),
        step_(image.like<float>(0)),
        misfit_(image.like<float>(0)),
        passed_(image.like<float>(0)) {
    dual_.fill(image.like<float>(0));
    const float median = median_of_positive(noise.values);
    for (std::size_t v = 0; v < noise.values.size(); ++v) {
      const float ratio = noise.values[v] > 0 ? median / noise.values[v] : 0;
      weight_.values[v] = std::min(ratio * ratio, heaviest);
      bound_.values[v] = static_cast<float>(strength) * median * (ratio > 0 ? ratio : 1);
    }
    const float mean = mean_of_known(image, noise);
    for (std::size_t v = 0; median > 0 && v < noise.values.size(); ++v)
      if (!(noise.values[v] > 0)) u_.values[v] = extrapolated_.values[v] = mean;
    choose_steps();
  }

  Volume<float> solve() {
    for (int round = 0; round < rounds; ++round) {
      ascend();
      measure_misfit();
      descend();
    }
    return std::move(u_);
  }

 private:
  void blur(Volume<float>& image) {
    if (side_ == 0) return;
    blur_along(0, side_, image, passed_);
    blur_along(1, side_, passed_, image);
    blur_along(2, side_, image, passed_);
    std::swap(image.values, passed_.values);
  }

  /// The blurred weight bounds the curvature of the misfit, row by row; 12 that of grad.
  void choose_steps() {
    step_ = weight_;
    blur(step_);
    for (float& step : step_.values) step = 0.99F / (step / 2 + 12 * dual_step);
  }

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
            return inside ? p.values[v] + dual_step * (u.values[next] - here) : 0.0F;
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

  /// The gradient of the misfit: blur (weight (blur u - image)).
  void measure_misfit() {
    misfit_.values = u_.values;
    blur(misfit_);
    tbb::parallel_for(std::size_t{0}, misfit_.values.size(), [&](std::size_t v) {
      misfit_.values[v] = weight_.values[v] * (misfit_.values[v] - image_.values[v]);
    });
    blur(misfit_);
  }

  /// u = u - step (misfit - div(dual)); extrapolated = 2 u - its last value.
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
          const float before = u_.values[v];
          const float now = before + step_.values[v] * (divergence - misfit_.values[v]);
          u_.values[v] = now;
          extrapolated_.values[v] = 2 * now - before;
        }
    });
  }

  Eigen::Vector3i size_;
  float side_;
  const Volume<float>& image_;
  Volume<float> u_, extrapolated_, weight_, bound_, step_, misfit_, passed_;
  std::array<Volume<float>, 3> dual_;
};

}  // namespace

Volume<float> total_variation_restored(const Volume<float>& image, const Volume<float>& noise,
                                       double strength, double blur_voxels) {
  return PrimalDual(image, noise, strength, blur_voxels).solve();
}

}  // namespace mammotwin
