#include "segmentation/chest_wall/wall_contrast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr float supported = -0.5F;
constexpr int inside_from_mm = 2, inside_to_mm = 6, rough_to_mm = 7;
constexpr int outside_from_mm = 2, outside_to_mm = 5;
constexpr int half_window = 15;  // rays: 30 mm, 22.5 degrees
constexpr int stride = 2;        // of the rays looked at
constexpr int block = 3;         // rays a side that share what their middle one sees
constexpr std::size_t least_rays = 25;
// Gland: bright tissue in front of the wall, below the skin; partial volume draws most of it
// towards fat.
constexpr int gland_from_mm = 3, gland_to_mm = 30, below_skin_mm = 5;
constexpr double pure_gland_quantile = 0.75;
constexpr std::size_t least_gland = 500;   // samples
constexpr double least_gland_step = 0.08;  // from muscle, of the logarithm
// The same in spreads, where gland lies beyond muscle from fat, and between the two: muscle mixed
// with fat is like gland then. In muscle of two real patients 95 % stay below.
constexpr double least_beyond = 1.3, least_between = 1.7;
constexpr double least_spread = 0.05;
// Muscle over fat, as far as the study saw it (1.4 to 2.0, 0.4) and a little more.
constexpr double least_bright = 1.2, most_bright = 2.2, least_dark = 0.2, most_dark = 0.7;
constexpr double study_bright = 2.0, study_dark = 0.65;
// Around a ratio beyond these, and what is still no fat.
constexpr double ratio_factor = 1.4, still_bright = 1.08, still_dark = 0.92;

double deviation(const float* ray, int low, int high) {
  low = std::clamp(low, 0, PolarRays::depths - 1);
  high = std::clamp(high, low + 1, PolarRays::depths);
  const double middle = mean_along(ray, low, high);
  double sum = 0;
  for (int d = low; d < high; ++d) sum += (ray[d] - middle) * (ray[d] - middle);
  return std::sqrt(sum / (high - low));
}

/// What lies on both sides of the wall along some rays. Logarithms as parts of the way from fat to
/// muscle.
struct Sides {
  std::vector<double> fat, muscle, roughness, muscle_logs, gland_logs;

  /// A ray whose wall is at sample `at`; its gland counts whether the image supports that or not.
  void add(const float* ray, int exit, int at, bool supported, double fat_to_muscle) {
    const auto log_at = [&](int d) { return std::log(ray[d]) / fat_to_muscle; };
    constexpr double middle = 0.5;
    for (int d = at + gland_from_mm; d < std::min(at + gland_to_mm, exit - below_skin_mm); ++d)
      if (const double log = log_at(d); log > middle) gland_logs.push_back(log);
    if (!supported) return;
    muscle.push_back(mean_along(ray, at - inside_to_mm, at - inside_from_mm));
    roughness.push_back(deviation(ray, at - rough_to_mm, at - inside_from_mm));
    fat.push_back(mean_along(ray, at + outside_from_mm, at + outside_to_mm));
    for (int d = std::max(0, at - inside_to_mm); d < at - inside_from_mm; ++d)
      muscle_logs.push_back(log_at(d));
  }
};

/// Adds gland, and the spread of muscle, where they can be told apart.
void add_gland(Sides& sides, double fat_to_muscle, WallContrast& contrast) {
  constexpr double quartiles_of_normal = 1.349;
  if (sides.gland_logs.size() < least_gland || sides.muscle_logs.empty()) return;
  const double spread = (quantile(sides.muscle_logs, 0.75) - quantile(sides.muscle_logs, 0.25)) *
                        std::abs(fat_to_muscle) / quartiles_of_normal;
  const double gland = quantile(sides.gland_logs, pure_gland_quantile) * fat_to_muscle;
  const double step = gland - std::log(contrast.muscle);
  const double least = step / fat_to_muscle > 0 ? least_beyond : least_between;
  if (std::abs(step) < std::max(least_gland_step, least * spread)) return;
  contrast.gland = std::exp(gland);
  contrast.spread = std::max(least_spread, spread);
}

/// As far from fat as the study saw, or around what was learnt of this image.
WallContrast within_reason(WallContrast c, const WallContrast& usual) {
  const double ratio = usual.muscle / usual.fat;
  double low = ratio > 1 ? least_bright : least_dark, high = ratio > 1 ? most_bright : most_dark;
  if (ratio > 1 && (ratio < least_bright || ratio > study_bright))
    low = std::max(still_bright, ratio / ratio_factor), high = ratio * ratio_factor;
  if (ratio < 1 && (ratio < least_dark || ratio > study_dark))
    low = ratio / ratio_factor, high = std::min(still_dark, ratio * ratio_factor);
  c.muscle = c.fat * std::clamp(c.muscle / c.fat, low, high);
  return c;
}

}  // namespace

std::vector<WallContrast> local_contrasts(const PolarRays& rays, const std::vector<double>& depth,
                                          const std::vector<float>& cost,
                                          const WallContrast& usual) {
  const double fat_to_muscle = std::log(usual.muscle / usual.fat);
  std::vector<WallContrast> contrasts(depth.size(), usual);
  const auto at = [&](int row, int angle) {
    return static_cast<std::size_t>(row) * rays.angles + angle;
  };
  const auto measured = [&](int row, int angle) {
    Sides sides;
    for (int r = std::max(0, row - half_window); r <= std::min(rays.rows - 1, row + half_window);
         r += stride)
      for (int a = std::max(0, angle - half_window);
           a <= std::min(rays.angles - 1, angle + half_window); a += stride) {
        const std::size_t n = at(r, a);
        sides.add(rays.ray(n), rays.exit[n], static_cast<int>(std::lround(depth[n])),
                  cost[n] <= supported, fat_to_muscle);
      }
    if (sides.fat.size() < least_rays) return usual;
    WallContrast found =
        within_reason({median(sides.fat), median(sides.muscle), median(sides.roughness)}, usual);
    add_gland(sides, fat_to_muscle, found);
    return found;
  };
  tbb::parallel_for(0, (rays.rows + block - 1) / block, [&](int b) {
    const int first_row = b * block, end_row = std::min(rays.rows, first_row + block);
    for (int first = 0; first < rays.angles; first += block) {
      const int end = std::min(rays.angles, first + block);
      const WallContrast here = measured((first_row + end_row) / 2, (first + end) / 2);
      for (int row = first_row; row < end_row; ++row)
        for (int angle = first; angle < end; ++angle) contrasts[at(row, angle)] = here;
    }
  });
  return contrasts;
}

}  // namespace mammotwin
