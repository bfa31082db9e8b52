#include "pipeline/synthesize/duct_tree.h"

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/implicit.h"
#include "pipeline/synthesize/lattice_noise.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double detour_weight = 0.55;  // of path to the nipple against new length
constexpr double under_skin_mm = 7, off_wall_mm = 7;
constexpr int attempts_per_lobule = 60;

struct Bud {
  Vector3d x;
  double path = 0;  // along the tree from the nipple [mm]
};

/// Lobules: in islands, denser in front of the middle and in the upper outer quadrant.
std::vector<Vector3d> scatter_lobules(const Chest& chest, Side side, std::uint64_t seed) {
  const BreastShape& b = chest.breast(side);
  CounterRandom random(seed, 41);
  const LatticeNoise islands(seed, 42, 0.42 * b.width);
  const double volume = b.width * b.height * b.length;
  const int wanted = std::clamp(static_cast<int>(volume / 170), 300, 1600);
  std::vector<Vector3d> lobules;
  for (int n = 0; n < attempts_per_lobule * wanted && static_cast<int>(lobules.size()) < wanted;
       ++n) {
    const double t = random.uniform(0.05, 1);
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), chance = random.uniform();
    const Vector3d x = b.axis(t) + Vector3d(b.outward * u * b.width, 0, v * b.height);
    if (chest.outside(x) > -under_skin_mm || chest.chest_wall(x) < off_wall_mm) continue;
    const double radial = u * u + v * v, upper_outer = 0.25 * (u + v);
    const double likely =
        (0.9 - 0.75 * radial + upper_outer) * smooth_step(-0.1, 0.4, t) * (0.4 + 2.0 * islands(x));
    if (chance < likely) lobules.push_back(x);
  }
  return lobules;
}

/// Bends a branch a little and lets it widen from the nipple outwards.
void add_branch(std::vector<Duct>& ducts, const Bud& from, const Vector3d& to,
                CounterRandom& random, double reach) {
  const double length = (to - from.x).norm();
  const Vector3d bend = 0.5 * (from.x + to) + 0.16 * length * random.direction();
  const double start = 0.7 + 0.5 * std::min(1.0, from.path / reach);
  const double end = random.uniform(0.4, 1.9);
  ducts.push_back({from.x, bend, start, start});
  ducts.push_back({bend, to, start, end});
}

}  // namespace

double Duct::distance(const Vector3d& x) const {
  const Vector3d axis = b - a;
  const double s = std::clamp((x - a).dot(axis) / std::max(axis.squaredNorm(), 1e-9), 0.0, 1.0);
  return (x - a - s * axis).norm() - (radius_a + s * (radius_b - radius_a));
}

std::vector<Duct> grow_ducts(const Chest& chest, Side side, std::uint64_t seed) {
  const Nipple& nipple = chest.nipple(side);
  std::vector<Vector3d> lobules = scatter_lobules(chest, side, seed);
  std::stable_sort(lobules.begin(), lobules.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - nipple.root).squaredNorm() < (b - nipple.root).squaredNorm();
  });
  CounterRandom random(seed, 43);
  const Vector3d root = nipple.root - 3 * nipple.direction;
  const double reach = chest.breast(side).length;
  std::vector<Bud> buds{{root, 0}};
  std::vector<Duct> ducts;
  for (const Vector3d& lobule : lobules) {
    const auto cost = [&](const Bud& bud) {
      const double step = (lobule - bud.x).norm();
      return step + detour_weight * (bud.path + step);
    };
    const Bud& best = *std::min_element(
        buds.begin(), buds.end(), [&](const Bud& a, const Bud& b) { return cost(a) < cost(b); });
    const Bud next{lobule, best.path + (lobule - best.x).norm()};
    add_branch(ducts, best, lobule, random, reach);
    buds.push_back(next);
  }
  return ducts;
}

}  // namespace mammotwin
