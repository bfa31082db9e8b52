#include "segmentation/pectoral_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "segmentation/semi_global_search.h"
#include "segmentation/smoothing.h"

namespace mammotwin {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double widest_degrees = 75, step_degrees = 1.5;
constexpr double row_mm = 2, axis_behind_mm = 110, beyond_slices_mm = 25;
constexpr double least_radius_mm = 30;
constexpr int depths = 210;  // of 1 mm
constexpr int inside_mm = 7, outside_mm = 6, edge_mm = 2, blur_mm = 1, below_skin_mm = 4,
              max_jump_mm = 4;
constexpr float forbidden = 10;

/// Log intensities along one ray, and how far it stays in the body.
struct Ray {
  std::vector<float> log_intensity;
  std::vector<float> intensity;
  int exit = 0;  ///< first depth outside the body
};

class RayCaster {
 public:
  RayCaster(const Volume<float>& image, const Volume<std::uint8_t>& body, const PectoralWall& map)
      : image_(image), body_(body), map_(map) {}

  Ray cast(int angle, int row) const {
    const double theta = map_.first_angle + angle * map_.angle_step;
    const double z = map_.first_z + row * map_.z_step;
    Ray ray;
    bool entered = false;
    for (int d = 0; d < depths; ++d) {
      const double r = least_radius_mm + d;
      const Eigen::Vector3d x(map_.axis_x + r * std::sin(theta), map_.axis_y - r * std::cos(theta),
                              z);
      const bool in = is_body(x);
      if (entered && !in) break;
      entered = entered || in;
      ray.exit = d + 1;
      const float value = in ? std::max(interpolated(image_, x), 0.02F) : 0.02F;
      ray.intensity.push_back(value);
      ray.log_intensity.push_back(std::log(value));
    }
    return ray;
  }

 private:
  bool is_body(const Eigen::Vector3d& x) const {
    const Eigen::Vector3i v = body_.index(x).array().round().cast<int>();
    return body_.contains(v.x(), v.y(), v.z()) && body_(v.x(), v.y(), v.z());
  }

  const Volume<float>& image_;
  const Volume<std::uint8_t>& body_;
  const PectoralWall& map_;
};

/// Mean brightness 3 to 8 mm behind the wall, of each ray.
std::vector<float> brightness_behind(const PectoralWall& wall, const Volume<float>& image) {
  constexpr int from_mm = 3, to_mm = 8;
  std::vector<float> behind;
  for (std::size_t n = 0; n < wall.radius.size(); ++n) {
    const double theta = wall.first_angle + static_cast<double>(n % wall.angles) * wall.angle_step;
    const double z = wall.first_z + static_cast<double>(n / wall.angles) * wall.z_step;
    float sum = 0;
    for (int d = from_mm; d <= to_mm; ++d) {
      const double r = wall.radius[n] - d;
      sum += interpolated(
          image, {wall.axis_x + r * std::sin(theta), wall.axis_y - r * std::cos(theta), z});
    }
    behind.push_back(sum / (to_mm - from_mm + 1));
  }
  return behind;
}

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
  explicit WallCost(const WallContrast& contrast) : log_muscle_(std::log(contrast.muscle)) {
    dark_ = 0.5 * std::min(1.0, contrast.muscle);
  }

  void fill(const Ray& ray, float* cost) const {
    std::vector<float> likelihood, dark;
    for (std::size_t d = 0; d < ray.intensity.size(); ++d) {
      likelihood.push_back(muscle_over_fat(ray.log_intensity[d]));
      dark.push_back(ray.intensity[d] < dark_ ? 1.0F : 0.0F);
    }
    const RunningSum logs(ray.log_intensity), muscle(likelihood), darks(dark);
    const int last = ray.exit - below_skin_mm;
    for (int d = 0; d < depths; ++d) {
      if (d < edge_mm + blur_mm || d > last) {
        cost[d] = forbidden;
        continue;
      }
      const double inside = muscle.mean(d - inside_mm, d);
      const double outside = muscle.mean(d, std::min(d + outside_mm, ray.exit - 2));
      const double region = (outside - inside) / strongest_;
      const double step = logs.mean(d + blur_mm, d + blur_mm + edge_mm) -
                          logs.mean(d - blur_mm - edge_mm, d - blur_mm);
      const double edge = std::clamp(-step / log_muscle_, -1.0, 1.0);
      const double dark_mm = darks.sum(d + 1, ray.exit - below_skin_mm);
      const double dark_inside = darks.mean(d - inside_mm, d);
      cost[d] = static_cast<float>(0.5 * region - 2 * edge + dark_mm / 10 + dark_inside);
    }
  }

 private:
  /// log p(muscle) - log p(fat), cut at +-3; both classes have the same spread. What is like
  /// neither (lung, vessels) says nothing: a hundredth of the peak is there for it.
  float muscle_over_fat(float log_intensity) const {
    constexpr double spread = 0.2;  // of log intensity: noise, texture and what bias is left
    constexpr double neither = 0.01;
    const auto likelihood = [&](double mean) {
      const double d = (log_intensity - mean) / spread;
      return std::exp(-0.5 * d * d) + neither;
    };
    const double ratio = std::log(likelihood(log_muscle_) / likelihood(0));
    return static_cast<float>(std::clamp(ratio, -strongest_, strongest_));
  }

  static constexpr double strongest_ = 3;
  double log_muscle_, dark_;
};

/// Median of the 3 x 3 around each point: single rays cannot step out.
std::vector<double> median_filtered(const std::vector<double>& map, int rows, int columns) {
  std::vector<double> out(map.size());
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      std::vector<double> near;
      for (int b = std::max(0, r - 1); b <= std::min(rows - 1, r + 1); ++b)
        for (int a = std::max(0, c - 1); a <= std::min(columns - 1, c + 1); ++a)
          near.push_back(map[static_cast<std::size_t>(b) * columns + a]);
      std::nth_element(near.begin(), near.begin() + near.size() / 2, near.end());
      out[static_cast<std::size_t>(r) * columns + c] = near[near.size() / 2];
    }
  return out;
}

PectoralWall laid_out(const Volume<float>& image, const BreastFrame& frame) {
  PectoralWall wall;
  wall.axis_x = frame.midline_x;
  wall.axis_y = frame.sternal_y + axis_behind_mm;
  wall.first_angle = -widest_degrees * degree;
  wall.angle_step = step_degrees * degree;
  wall.angles = static_cast<int>(std::lround(2 * widest_degrees / step_degrees)) + 1;
  const double top = image.position(0, 0, image.size.z() - 1).z();
  const double low = std::max(image.origin.z(), frame.z_low - beyond_slices_mm);
  const double high = std::min(top, frame.z_high + beyond_slices_mm);
  wall.first_z = low;
  wall.z_step = row_mm;
  wall.rows = std::max(1, static_cast<int>((high - low) / row_mm) + 1);
  return wall;
}

}  // namespace

PectoralWall find_pectoral_wall(const Volume<float>& corrected, const Volume<std::uint8_t>& body,
                                const BreastFrame& frame, const WallContrast& contrast,
                                double stiffness) {
  PectoralWall wall = laid_out(corrected, frame);
  std::vector<float> cost(static_cast<std::size_t>(wall.rows) * wall.angles * depths);
  const RayCaster caster(corrected, body, wall);
  const WallCost price(contrast);
  tbb::parallel_for(0, wall.rows, [&](int row) {
    for (int a = 0; a < wall.angles; ++a)
      price.fill(caster.cast(a, row),
                 &cost[(static_cast<std::size_t>(row) * wall.angles + a) * depths]);
  });
  std::vector<double> depth =
      semi_global_search(cost, wall.rows, wall.angles, depths, stiffness, max_jump_mm);
  depth = median_filtered(depth, wall.rows, wall.angles);
  for (std::size_t n = 0; n < depth.size(); ++n) {
    wall.cost.push_back(cost[n * depths + static_cast<std::size_t>(std::lround(depth[n]))]);
    wall.radius.push_back(least_radius_mm + depth[n] - 0.5);  // between the samples d - 1 and d
  }
  wall.behind = brightness_behind(wall, corrected);
  return wall;
}

bool PectoralWall::is_behind(const Eigen::Vector3d& x_in_lps) const {
  const double dx = x_in_lps.x() - axis_x, dy = axis_y - x_in_lps.y();
  const double a = std::clamp((std::atan2(dx, dy) - first_angle) / angle_step, 0.0, angles - 1.0);
  const double b = std::clamp((x_in_lps.z() - first_z) / z_step, 0.0, rows - 1.0);
  const int a0 = std::min(static_cast<int>(a), std::max(0, angles - 2));
  const int b0 = std::min(static_cast<int>(b), std::max(0, rows - 2));
  const int a1 = std::min(a0 + 1, angles - 1), b1 = std::min(b0 + 1, rows - 1);
  const double s = a - a0, t = b - b0;
  const auto r = [&](int row, int angle) {
    return radius[static_cast<std::size_t>(row) * angles + angle];
  };
  const double here =
      (1 - t) * ((1 - s) * r(b0, a0) + s * r(b0, a1)) + t * ((1 - s) * r(b1, a0) + s * r(b1, a1));
  return dx * dx + dy * dy < here * here;
}

std::vector<std::size_t> PectoralWall::rays_before(Side side, double z_low, double z_high) const {
  constexpr double front_degrees = 50;
  std::vector<std::size_t> rays;
  for (int row = 0; row < rows; ++row)
    for (int a = 0; a < angles; ++a) {
      const double angle = first_angle + a * angle_step, z = first_z + row * z_step;
      const double outward = side == Side::left ? angle : -angle;
      if (outward < 0 || outward > front_degrees * degree || z < z_low || z > z_high) continue;
      rays.push_back(static_cast<std::size_t>(row) * angles + a);
    }
  return rays;
}

double PectoralWall::doubt(Side side, double z_low, double z_high) const {
  constexpr double supported = -0.5;
  const std::vector<std::size_t> rays = rays_before(side, z_low, z_high);
  if (rays.empty()) return 1;
  double weak = 0;
  for (const std::size_t n : rays) weak += cost[n] > supported;
  return weak / static_cast<double>(rays.size());
}

double PectoralWall::fat_behind(Side side, double z_low, double z_high, double muscle) const {
  const std::vector<std::size_t> rays = rays_before(side, z_low, z_high);
  if (rays.empty()) return 1;
  constexpr float least = 0.02F;  // noise can leave nothing of a value
  const double middle = std::log(muscle) / 2;
  double fat = 0;
  for (const std::size_t n : rays) {
    const double value = std::log(std::max(behind[n], least));
    fat += muscle > 1 ? value < middle : value > middle;
  }
  return fat / static_cast<double>(rays.size());
}

}  // namespace mammotwin
