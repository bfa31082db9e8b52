#include "segmentation/chest_wall/polar_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

bool holds(const Volume<std::uint8_t>& body, const Eigen::Vector3d& x) {
  const Eigen::Vector3i v = body.index(x).array().round().cast<int>();
  return body.contains(v.x(), v.y(), v.z()) && body(v.x(), v.y(), v.z());
}

}  // namespace

double mean_along(const float* ray, int low, int high) {
  low = std::clamp(low, 0, PolarRays::depths - 1);
  high = std::clamp(high, low + 1, PolarRays::depths);
  return std::accumulate(ray + low, ray + high, 0.0) / (high - low);
}

PolarRays cast_rays(const Volume<float>& image, const Volume<std::uint8_t>& body,
                    const PectoralWall& grid) {
  const std::size_t count = static_cast<std::size_t>(grid.rows) * grid.angles;
  PolarRays rays{grid.rows, grid.angles, {}, std::vector<int>(count, 0)};
  rays.intensity.assign(count * PolarRays::depths, PolarRays::least_intensity);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
    float* intensity = &rays.intensity[n * PolarRays::depths];
    bool entered = false;
    for (int d = 0; d < PolarRays::depths; ++d) {
      const Eigen::Vector3d x = grid.position(n, PolarRays::least_radius_mm + d);
      const bool in = holds(body, x);
      if (entered && !in) break;
      entered = entered || in;
      rays.exit[n] = d + 1;
      if (in) intensity[d] = std::max(interpolated(image, x), PolarRays::least_intensity);
    }
  });
  return rays;
}

}  // namespace mammotwin
