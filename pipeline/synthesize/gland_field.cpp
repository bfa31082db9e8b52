#include "pipeline/synthesize/gland_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/synthesize/lattice_noise.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double grid_mm = 1;
constexpr double reach_mm = 8;  // ducts are felt this far
constexpr float nowhere = 1e6f;

Volume<float> breast_grid(const BreastShape& b) {
  const double side = b.width * 1.15 + b.turn, up = b.height * 1.2, down = b.height * 1.1 + b.sag;
  const Vector3d low(b.base.x() - side, b.base.y() - 1.3 * b.length, b.base.z() - down);
  const Vector3d high(b.base.x() + side, b.base.y() + 25, b.base.z() + up);
  const Vector3i size = ((high - low) / grid_mm).cast<int>() + Vector3i::Ones();
  return Volume<float>(size, Vector3d::Constant(grid_mm), low, static_cast<float>(reach_mm));
}

/// Lowers the field to the distance from one duct within reach, in the slices [from, to).
void stamp(Volume<float>& field, const Duct& duct, int from, int to) {
  const Vector3d margin = Vector3d::Constant(reach_mm + std::max(duct.radius_a, duct.radius_b));
  const Vector3i low = field.index(duct.a.cwiseMin(duct.b) - margin).cast<int>().cwiseMax(0);
  const Vector3i high =
      (field.index(duct.a.cwiseMax(duct.b) + margin).cast<int>() + Vector3i::Ones())
          .cwiseMin(field.size - Vector3i::Ones());
  for (int k = std::max(low.z(), from); k <= std::min(high.z(), to - 1); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) {
        float& value = field(i, j, k);
        value = std::min(value, static_cast<float>(duct.distance(field.position(i, j, k))));
      }
}

void stamp_all(Volume<float>& field, const std::vector<Duct>& ducts) {
  constexpr int slab = 8;
  tbb::parallel_for(0, (field.size.z() + slab - 1) / slab, [&](int s) {
    for (const Duct& duct : ducts)
      stamp(field, duct, s * slab, std::min((s + 1) * slab, field.size.z()));
  });
}

/// Coordinates in which directions from the nipple are 45 mm long and depth is shortened: noise of
/// them is drawn out into fibres that fan back from the nipple.
Vector3d fanned(const Vector3d& x, const Vector3d& nipple) {
  const Vector3d from = x - nipple;
  const double r = std::max(from.norm(), 1.0);
  return from / r * (45 + 0.3 * r);
}

/// Roughens the field and raises it under the skin and on the wall; `nowhere` outside the breast.
void roughen(Volume<float>& field, const Chest& chest, Side side, std::uint64_t seed,
             double fat_margin_mm) {
  const LatticeNoise coarse(seed, 51, 12), fibres(seed, 52, 5), fine(seed, 53, 3.5);
  const BreastShape& breast = chest.breast(side);
  const Nipple& nipple = chest.nipple(side);
  tbb::parallel_for(0, field.size.z(), [&](int k) {
    for (int j = 0; j < field.size.y(); ++j)
      for (int i = 0; i < field.size.x(); ++i) {
        const Vector3d x = field.position(i, j, k);
        float& value = field(i, j, k);
        if (breast.distance(x) > 4) {
          value = nowhere;
          continue;
        }
        const double under_skin = -chest.outside(x), off_wall = chest.chest_wall(x);
        if (under_skin < 0 || off_wall < 1) {
          value = nowhere;
          continue;
        }
        // Ducts come up to the skin at the nipple only.
        const double from_nipple = (x - nipple.root).norm();
        const double margin = fat_margin_mm * std::min(1.0, from_nipple / 25);
        const double lack = std::max(0.0, margin - std::min(under_skin, 1.5 * off_wall));
        const double beyond = std::max(0.0, breast.distance(x));
        const double sheet = std::min(1.0, std::abs(fibres(fanned(x, nipple.root))) / 0.35);
        value += static_cast<float>(2.2 * coarse(x) + 2.6 * sheet + 0.8 * fine(x) +
                                    0.35 * lack * lack + beyond);
      }
  });
}

/// The level under which the field holds `volume_mm3`.
float level_of_volume(const Volume<float>& field, double volume_mm3) {
  std::vector<float> sorted;
  for (const float v : field.values)
    if (v < nowhere) sorted.push_back(v);
  const auto wanted =
      std::min(static_cast<std::size_t>(volume_mm3 / field.voxel_volume()), sorted.size() - 1);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(wanted),
                   sorted.end());
  return sorted[wanted];
}

}  // namespace

GlandField::GlandField(const Chest& chest, Side side, std::uint64_t seed, double volume_mm3,
                       double fat_margin_mm)
    : field_(breast_grid(chest.breast(side))) {
  stamp_all(field_, grow_ducts(chest, side, seed));
  roughen(field_, chest, side, seed, fat_margin_mm);
  const float level = level_of_volume(field_, volume_mm3);
  for (float& v : field_.values) v -= level;
}

double GlandField::operator()(const Vector3d& x) const {
  const Vector3d at = field_.index(x);
  const Vector3d base = at.array().floor();
  const Vector3i b = base.cast<int>();
  if (!field_.contains(b.x(), b.y(), b.z()) || !field_.contains(b.x() + 1, b.y() + 1, b.z() + 1))
    return 1;
  const Vector3d f = at - base;
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const int di = c & 1, dj = (c >> 1) & 1, dk = c >> 2;
    sum += (di ? f.x() : 1 - f.x()) * (dj ? f.y() : 1 - f.y()) * (dk ? f.z() : 1 - f.z()) *
           field_(b.x() + di, b.y() + dj, b.z() + dk);
  }
  return sum;
}

}  // namespace mammotwin
