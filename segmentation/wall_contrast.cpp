#include "segmentation/wall_contrast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

constexpr float supported = -0.5F;
constexpr int inside_from_mm = 2, inside_to_mm = 6, rough_to_mm = 7;
constexpr int outside_from_mm = 2, outside_to_mm = 5;
constexpr int half_window = 15;  // rays: 30 mm, 22.5 degrees
constexpr int stride = 2;        // of the rays looked at
constexpr std::size_t least_rays = 25;
// Muscle over fat, as far as the study saw it (1.4 to 2.0, 0.4) and a little more.
constexpr double least_bright = 1.2, most_bright = 2.2, least_dark = 0.2, most_dark = 0.7;

double deviation(const float* ray, int low, int high) {
  low = std::clamp(low, 0, PolarRays::depths - 1);
  high = std::clamp(high, low + 1, PolarRays::depths);
  const double middle = mean_along(ray, low, high);
  double sum = 0;
  for (int d = low; d < high; ++d) sum += (ray[d] - middle) * (ray[d] - middle);
  return std::sqrt(sum / (high - low));
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

WallContrast within_reason(WallContrast c, const WallContrast& usual) {
  const bool bright = usual.muscle > usual.fat;
  c.muscle = c.fat * std::clamp(c.muscle / c.fat, bright ? least_bright : least_dark,
                                bright ? most_bright : most_dark);
  return c;
}

}  // namespace

std::vector<WallContrast> local_contrasts(const PolarRays& rays, const std::vector<double>& depth,
                                          const std::vector<float>& cost,
                                          const WallContrast& usual) {
  std::vector<WallContrast> seen(depth.size());
  for (std::size_t n = 0; n < depth.size(); ++n) {
    const int at = static_cast<int>(std::lround(depth[n]));
    seen[n].muscle = mean_along(rays.ray(n), at - inside_to_mm, at - inside_from_mm);
    seen[n].roughness = deviation(rays.ray(n), at - rough_to_mm, at - inside_from_mm);
    seen[n].fat = mean_along(rays.ray(n), at + outside_from_mm, at + outside_to_mm);
  }
  std::vector<WallContrast> contrasts(depth.size(), usual);
  tbb::parallel_for(0, rays.rows, [&](int row) {
    for (int angle = 0; angle < rays.angles; ++angle) {
      std::vector<double> fat, muscle, roughness;
      for (int r = std::max(0, row - half_window); r <= std::min(rays.rows - 1, row + half_window);
           r += stride)
        for (int a = std::max(0, angle - half_window);
             a <= std::min(rays.angles - 1, angle + half_window); a += stride) {
          const std::size_t n = static_cast<std::size_t>(r) * rays.angles + a;
          if (cost[n] > supported) continue;
          fat.push_back(seen[n].fat), muscle.push_back(seen[n].muscle);
          roughness.push_back(seen[n].roughness);
        }
      if (fat.size() < least_rays) continue;
      contrasts[static_cast<std::size_t>(row) * rays.angles + angle] =
          within_reason({median(fat), median(muscle), median(roughness)}, usual);
    }
  });
  return contrasts;
}

}  // namespace mammotwin
