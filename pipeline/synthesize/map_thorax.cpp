#include "pipeline/synthesize/map_thorax.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/lattice_noise.h"
#include "pipeline/synthesize/tissue_map.h"
#include "pipeline/synthesize/torso.h"
#include "segmentation/body/breast_region.h"
#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Mask = Volume<std::uint8_t>;

constexpr double widest_gap_mm = 25;

/// Bridges gaps between columns that have a front.
void bridge(const Mask& map, int k, WallFront& front) {
  const int none = map.size.y(), widest = static_cast<int>(widest_gap_mm / map.spacing.x());
  int before = -1;
  for (int i = 0; i < map.size.x(); ++i) {
    if (front.at(i, k) == none) continue;
    for (int n = before + 1; before >= 0 && n < i && i - before <= widest; ++n) {
      const double t = static_cast<double>(n - before) / (i - before);
      front.at(n, k) =
          static_cast<int>(std::lround((1 - t) * front.at(before, k) + t * front.at(i, k)));
    }
    before = i;
  }
}

class Thorax {
 public:
  Thorax(std::uint64_t seed, const Vector3d& front_middle)
      : muscle_(seed, 101, 45), ripple_(seed, 102, 35), vessels_(seed, 103, 9) {
    CounterRandom random(seed, 104);
    mean_mm_ = random.uniform(13, 20);
    heart_ = front_middle + Vector3d(25, 55, -15);
    liver_ = front_middle + Vector3d(-55, 95, -125);
  }

  /// At a point `depth` mm behind the front.
  Substance at(const Vector3d& x, double depth) const {
    const double muscle = std::clamp(mean_mm_ + 5 * muscle_(Vector3d(x.x(), 0, x.z())), 10.0, 25.0);
    if (depth < muscle) return Substance::muscle;
    if (depth < muscle + rib_mm)
      return is_rib(x, depth - muscle) ? Substance::rib : Substance::muscle;
    const Vector3d h = x - heart_, l = x - liver_;
    if (h.cwiseQuotient(Vector3d(58, 46, 60)).squaredNorm() < 1 + 0.15 * ripple_(x))
      return Substance::heart;
    if (l.cwiseQuotient(Vector3d(110, 95, 95)).squaredNorm() < 1) return Substance::liver;
    return vessels_(x) > 0.52 ? Substance::heart : Substance::lung;  // blood either way
  }

 private:
  bool is_rib(const Vector3d& x, double into_mm) const {
    if (std::abs(x.x()) < sternum_half_mm) return true;
    const double along = x.z() + 0.45 * std::abs(x.x()) + 4 * ripple_(x);
    const double from_rib = along - rib_pitch_mm * std::floor(along / rib_pitch_mm + 0.5);
    const double across = from_rib / (rib_pitch_mm / 4), into = into_mm / (rib_mm / 2) - 1;
    return across * across + into * into < 1;
  }

  LatticeNoise muscle_, ripple_, vessels_;
  double mean_mm_ = 16;
  Vector3d heart_, liver_;
};

/// Mean place of the front near the middle of the body.
Vector3d middle_of(const WallFront& front, const Mask& map) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int k = 0; k < map.size.z(); ++k)
    for (int i = 0; i < map.size.x(); ++i) {
      if (front.at(i, k) == map.size.y()) continue;
      const Vector3d x = map.position(i, front.at(i, k), k);
      if (std::abs(x.x()) < 40) sum += x, ++count;
    }
  return count > 0 ? Vector3d(sum / count) : map.position(0, 0, 0);
}

}  // namespace

WallFront front_of_muscle(const Mask& substance) {
  auto muscle = substance.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < muscle.values.size(); ++v)
    muscle.values[v] = substance.values[v] == static_cast<std::uint8_t>(Substance::muscle);
  muscle = without_small_components(muscle, least_muscle_ml);
  WallFront front{substance.size.x(), {}};
  for (int k = 0; k < substance.size.z(); ++k)
    for (int i = 0; i < substance.size.x(); ++i) {
      int j = 0;
      while (j < substance.size.y() && !muscle(i, j, k)) ++j;
      front.rows.push_back(j);
    }
  for (int k = 0; k < substance.size.z(); ++k) bridge(substance, k, front);
  return front;
}

void fill_thorax(const WallFront& front, std::uint64_t seed, Mask& substance) {
  auto ahead = substance.like<std::uint8_t>(0);  // tissue in front of the wall, or beside it
  for (int k = 0; k < substance.size.z(); ++k)
    for (int i = 0; i < substance.size.x(); ++i)
      for (int j = 0; j < std::min(front.at(i, k), substance.size.y()); ++j)
        ahead(i, j, k) = substance(i, j, k) != 0;
  const Volume<float> depth = distance_to(ahead);
  const Thorax thorax(seed, middle_of(front, substance));
  tbb::parallel_for(0, substance.size.z(), [&](int k) {
    for (int i = 0; i < substance.size.x(); ++i)
      for (int j = front.at(i, k); j < substance.size.y(); ++j)
        substance(i, j, k) =
            static_cast<std::uint8_t>(thorax.at(substance.position(i, j, k), depth(i, j, k)));
    // Pieces of muscle that are no front are fat.
    for (int i = 0; i < substance.size.x(); ++i)
      for (int j = 0; j < std::min(front.at(i, k), substance.size.y()); ++j)
        if (substance(i, j, k) == static_cast<std::uint8_t>(Substance::muscle))
          substance(i, j, k) = static_cast<std::uint8_t>(Substance::fat);
  });
}

}  // namespace mammotwin
