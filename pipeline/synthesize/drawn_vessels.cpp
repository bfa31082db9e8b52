#include "pipeline/synthesize/drawn_vessels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/synthesize/counter_random.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double fat_ml_per_vessel = 60;
constexpr double step_mm = 1, least_radius_mm = 0.9, most_radius_mm = 2.5, taper = 0.6;
constexpr double least_length_mm = 40, most_length_mm = 140;
constexpr double wander = 0.12;  // a step's change of direction
constexpr double turn = 0.8;     // where the way is barred
constexpr int turns = 8;

/// Where vessels may run, and what they cover.
class VesselBed {
 public:
  explicit VesselBed(const TissueMap& tissue)
      : tissue_(tissue), cover_(tissue.mixtures.like<float>(0)) {
    for (std::size_t v = 0; v < tissue.mixtures.values.size(); ++v)
      if (tissue.mixtures.values[v][Substance::fat] == tissue.parts_per_voxel) fat_.push_back(v);
  }

  int num_vessels() const {
    return static_cast<int>(static_cast<double>(fat_.size()) * cover_.voxel_volume() / 1000 /
                            fat_ml_per_vessel);
  }

  void grow(CounterRandom random) {
    Vector3d x = cover_.position(
        fat_[static_cast<std::size_t>(random.uniform(0, static_cast<double>(fat_.size())))]);
    Vector3d along = random.direction();
    const double radius = random.uniform(least_radius_mm, most_radius_mm);
    const double length = random.uniform(least_length_mm, most_length_mm);
    for (double way = 0; way < length; way += step_mm) {
      cover(x, radius * (1 - (1 - taper) * way / length));
      Vector3d ahead = (along + wander * random.direction()).normalized();
      for (int n = 0; n < turns && !is_open(x + 3 * step_mm * ahead); ++n)
        ahead = (along + turn * random.direction()).normalized();
      if (!is_open(x + step_mm * ahead)) return;
      x += step_mm * ahead, along = ahead;
    }
  }

  const Volume<float>& covered() const { return cover_; }

 private:
  bool is_open(const Vector3d& x) const {
    const Eigen::Vector3i v = cover_.index(x).array().round().cast<int>();
    if (!cover_.contains(v.x(), v.y(), v.z())) return false;
    const VoxelMixture& m = tissue_.mixtures(v.x(), v.y(), v.z());
    return m[Substance::fat] + m[Substance::fibroglandular] == tissue_.parts_per_voxel;
  }

  /// A ball, whose rim covers voxels in part.
  void cover(const Vector3d& x, double radius) {
    const Eigen::Vector3d index = cover_.index(x);
    const double voxel = cover_.spacing.mean();
    const int reach = static_cast<int>(std::ceil(radius / voxel)) + 1;
    const Eigen::Vector3i middle = index.array().round().cast<int>();
    for (int k = middle.z() - reach; k <= middle.z() + reach; ++k)
      for (int j = middle.y() - reach; j <= middle.y() + reach; ++j)
        for (int i = middle.x() - reach; i <= middle.x() + reach; ++i) {
          if (!cover_.contains(i, j, k)) continue;
          const double distance = (cover_.position(i, j, k) - x).norm();
          const double share = std::clamp(0.5 + (radius - distance) / voxel, 0.0, 1.0);
          cover_(i, j, k) = std::max(cover_(i, j, k), static_cast<float>(share));
        }
  }

  const TissueMap& tissue_;
  Volume<float> cover_;
  std::vector<std::size_t> fat_;
};

}  // namespace

void draw_vessels(double brightness, std::uint64_t seed, const TissueMap& tissue,
                  Volume<float>& signal) {
  VesselBed bed(tissue);
  for (int n = 0; n < bed.num_vessels(); ++n) {
    constexpr std::uint64_t first_stream = 1000;
    bed.grow(CounterRandom(seed, first_stream + n));
  }
  for (std::size_t v = 0; v < signal.values.size(); ++v) {
    const VoxelMixture& m = tissue.mixtures.values[v];
    const auto open = static_cast<float>(m[Substance::fat] + m[Substance::fibroglandular]) /
                      static_cast<float>(tissue.parts_per_voxel);
    const float share = open * bed.covered().values[v];
    signal.values[v] += share * (static_cast<float>(brightness) - signal.values[v]);
  }
}

}  // namespace mammotwin
