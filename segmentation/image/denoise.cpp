#include "segmentation/image/denoise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mammotwin {
namespace {

constexpr int reach = 2;
constexpr double furthest_squared = 5;  // voxels^2: leaves the cube's corners out
constexpr double near_voxels = 1.2, like_noises = 2;

struct Neighbour {
  int i, j, k;
  float weight;
};

std::vector<Neighbour> neighbours() {
  std::vector<Neighbour> out;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        if (const double r2 = i * i + j * j + k * k; r2 <= furthest_squared)
          out.push_back(
              {i, j, k, static_cast<float>(std::exp(-0.5 * r2 / near_voxels / near_voxels))});
  return out;
}

/// exp(-d^2 / 2) of a difference in units of the likeness, by table; 0 from 4 on.
class Likeness {
 public:
  explicit Likeness(double unit) : steps_per_value_(static_cast<float>(steps / 4.0 / unit)) {
    for (int n = 0; n < steps; ++n) {
      const double d = 4.0 * (n + 0.5) / steps;
      table_[n] = static_cast<float>(std::exp(-0.5 * d * d));
    }
  }
  float operator()(float difference) const {
    const float at = std::abs(difference) * steps_per_value_;
    return at < steps ? table_[static_cast<int>(at)] : 0;
  }

 private:
  static constexpr int steps = 256;
  float steps_per_value_;
  std::array<float, steps> table_{};
};

}  // namespace

Volume<float> denoised(const Volume<float>& image, double noise) {
  if (!(noise > 0)) return image;
  const std::vector<Neighbour> around = neighbours();
  const Likeness likeness(like_noises * noise);
  Volume<float> out = image.like<float>(0);
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const float here = image(i, j, k);
        float sum = 0, weight = 0;
        for (const Neighbour& n : around) {
          if (!image.contains(i + n.i, j + n.j, k + n.k)) continue;
          const float value = image(i + n.i, j + n.j, k + n.k);
          const float w = n.weight * likeness(value - here);
          sum += w * value, weight += w;
        }
        out(i, j, k) = sum / weight;
      }
  });
  return out;
}

}  // namespace mammotwin
