#include "segmentation/chest_wall/wall_cost.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

constexpr int inside_mm = 7, outside_mm = 6, edge_mm = 2, blur_mm = 1, clear_of_skin_mm = 4;
constexpr int texture_from_mm = 2, texture_to_mm = 7;  // inside: clear of the edge's blur
constexpr float forbidden = 10;

/// Means over pieces of a ray in constant time.
class RunningSum {
 public:
  explicit RunningSum(const std::vector<float>& values) : sum_(values.size() + 1, 0) {
    for (std::size_t n = 0; n < values.size(); ++n) sum_[n + 1] = sum_[n] + values[n];
  }
  /// Sum over [low, high), clipped to the ray.
  double sum(int low, int high) const {
    const int n = static_cast<int>(sum_.size()) - 1;
    low = std::clamp(low, 0, n), high = std::clamp(high, low, n);
    return sum_[high] - sum_[low];
  }
  double mean(int low, int high) const {
    const int n = static_cast<int>(sum_.size()) - 1;
    low = std::clamp(low, 0, n), high = std::clamp(high, low, n);
    return high > low ? (sum_[high] - sum_[low]) / (high - low) : 0;
  }

 private:
  std::vector<double> sum_;
};

class WallCost {
 public:
  explicit WallCost(const WallContrast& contrast)
      : log_fat_(std::log(contrast.fat)),
        log_muscle_(std::log(contrast.muscle)),
        log_gland_(std::log(contrast.gland > 0 ? contrast.gland : contrast.fat)),
        spread_(contrast.spread),
        roughness_(contrast.roughness),
        knows_gland_(contrast.gland > 0) {
    dark_ = 0.5 * std::min(contrast.fat, contrast.muscle);
  }

  void fill(const float* ray, int exit, float* cost) const {
    std::vector<float> log_intensity, likelihood, dark, value(ray, ray + exit), square;
    for (int d = 0; d < exit; ++d) {
      log_intensity.push_back(std::log(ray[d]));
      likelihood.push_back(muscle_over_others(log_intensity.back()));
      square.push_back(ray[d] * ray[d]);
      dark.push_back(ray[d] < dark_ ? 1.0F : 0.0F);
    }
    const RunningSum logs(log_intensity), muscle(likelihood), darks(dark), values(value),
        squares(square);
    const int last = exit - clear_of_skin_mm;
    for (int d = 0; d < PolarRays::depths; ++d) {
      if (d < edge_mm + blur_mm || d > last) {
        cost[d] = forbidden;
        continue;
      }
      const double inside = muscle.mean(d - inside_mm, d);
      const double outside = muscle.mean(d, std::min(d + outside_mm, exit - 2));
      const double region = (outside - inside) / strongest_;
      const double edge = knows_gland_ ? outward_fall(muscle, d) / (2 * strongest_)
                                       : outward_fall(logs, d) / (log_muscle_ - log_fat_);
      const double dark_mm = darks.sum(d + 1, exit - clear_of_skin_mm);
      const double dark_inside = darks.mean(d - inside_mm, d);
      cost[d] = static_cast<float>(0.5 * region - 2 * std::clamp(edge, -1.0, 1.0) + dark_mm / 10 +
                                   dark_inside + 2 * roughness(values, squares, d));
    }
  }

 private:
  /// Mean 1 to 3 mm inside less that 1 to 3 mm outside.
  static double outward_fall(const RunningSum& along, int d) {
    return along.mean(d - blur_mm - edge_mm, d - blur_mm) -
           along.mean(d + blur_mm, d + blur_mm + edge_mm);
  }

  /// How much rougher than muscle the inside is: 0 up to 1.5 times, 1 from 3 times on.
  double roughness(const RunningSum& values, const RunningSum& squares, int d) const {
    if (roughness_ <= 0) return 0;
    constexpr double harmless = 1.5, full = 3;
    const double mean = values.mean(d - texture_to_mm, d - texture_from_mm);
    const double variance = squares.mean(d - texture_to_mm, d - texture_from_mm) - mean * mean;
    const double ratio = std::sqrt(std::max(0.0, variance)) / roughness_;
    return std::clamp((ratio - harmless) / (full - harmless), 0.0, 1.0);
  }

  /// log p(muscle) less that of fat or gland, whichever is likelier, cut at +-3; all have the same
  /// spread. What is like none of them (lung, vessels) says nothing: a hundredth of the peak is
  /// there for it.
  float muscle_over_others(float log_intensity) const {
    constexpr double none = 0.01;
    const auto likelihood = [&](double mean) {
      const double d = (log_intensity - mean) / spread_;
      return std::exp(-0.5 * d * d) + none;
    };
    const double others = std::max(likelihood(log_fat_), likelihood(log_gland_));
    const double ratio = std::log(likelihood(log_muscle_) / others);
    return static_cast<float>(std::clamp(ratio, -strongest_, strongest_));
  }

  static constexpr double strongest_ = 3;
  double log_fat_, log_muscle_, log_gland_, spread_, roughness_, dark_;
  bool knows_gland_;
};

}  // namespace

std::vector<float> wall_costs(const PolarRays& rays, const std::vector<WallContrast>& contrast) {
  std::vector<float> costs(rays.intensity.size());
  tbb::parallel_for(std::size_t{0}, rays.exit.size(), [&](std::size_t n) {
    WallCost(contrast[n]).fill(rays.ray(n), rays.exit[n], &costs[n * PolarRays::depths]);
  });
  return costs;
}

}  // namespace mammotwin
