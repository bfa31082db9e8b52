#include "pipeline/synthesize/chest.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "pipeline/synthesize/counter_random.h"
#include "pipeline/synthesize/implicit.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr double fillet_mm = 15;
constexpr double lumpy_mm = 14;  // irregularity is left out further than this from the skin
constexpr double column_mm = 3, depth_step_mm = 1.5;
constexpr double skipped_mm = 8;  // far from the skin, distances are trusted to this much
constexpr double lower_mm = -135, upper_mm = 135;  // rows searched for the region
constexpr double volume_tolerance = 0.007;

}  // namespace

Chest::Chest(const AnatomyOptions& o) : torso_(o), broad_(o.seed, 21, 48), fine_(o.seed, 22, 23) {
  double scale = std::cbrt(o.volume_ml / 650);
  double reached = 0;
  for (int i = 0; i < 14; ++i) {
    shape_breasts(o, scale);
    const ColumnMap map = columns();
    reached = volume_ml(map, true_region(map, o.side, {}));
    if (std::abs(reached / o.volume_ml - 1) < volume_tolerance) return;
    scale *= std::clamp(std::cbrt(o.volume_ml / reached), 0.7, 1.4);
    if (scale < 0.2 || scale > 3) break;
  }
  std::ostringstream message;
  message << "synthetic patient: volume_ml is " << o.volume_ml << ", but with subcutaneous_mm "
          << o.subcutaneous_mm << " and chest_half_width_mm " << o.chest_half_width_mm
          << " the breast has " << reached << " ml; change one of them";
  throw std::invalid_argument(message.str());
}

void Chest::shape_breasts(const AnatomyOptions& o, double scale) {
  for (const Side side : {Side::left, Side::right}) {
    const double larger = side == o.side ? 1 : std::cbrt(1 + o.asymmetry);
    breasts_[static_cast<int>(side)] = shape_breast(o, side, scale * larger);
  }
  for (int s = 0; s < 2; ++s) nipples_[s] = place_nipple(breasts_[s], o.seed + s);
}

BreastShape Chest::shape_breast(const AnatomyOptions& o, Side side, double scale) const {
  CounterRandom random(o.seed, side == Side::left ? 31 : 32);
  BreastShape b;
  b.outward = side == Side::left ? 1 : -1;
  const double oval = random.uniform(1.10, 1.30);  // height over width
  const double stretch = std::cbrt(1.6 / o.projection);
  b.width = 50 * scale * stretch, b.height = oval * b.width;
  b.length = o.projection * std::sqrt(b.width * b.height);
  b.turn = b.length * random.uniform(-0.02, 0.12);
  b.sag = b.length * (0.35 * o.ptosis + random.uniform(-0.03, 0.03));
  b.roundness = random.uniform(2.1, 2.8);
  b.neck = random.uniform(0.02, 0.14);
  const double x = b.outward * (30 + 0.98 * b.width), z = random.uniform(-6, 6) + b.sag / 2;
  b.base = {x, torso_.wall_y(x, z), z};
  return b;
}

Nipple Chest::place_nipple(const BreastShape& breast, std::uint64_t seed) const {
  CounterRandom random(seed, 33);
  Nipple n;
  n.direction = Vector3d(breast.outward * random.uniform(0, 0.25), -1, random.uniform(-0.12, 0.12))
                    .normalized();
  n.height = random.uniform(5, 7), n.radius = random.uniform(4.5, 5.5);
  const Vector3d start = breast.axis(0.5);
  double inside = 0, outside = 3 * breast.length;
  for (int i = 0; i < 50; ++i) {
    const double middle = (inside + outside) / 2;
    (without_nipples(start + middle * n.direction) < 0 ? inside : outside) = middle;
  }
  n.root = start + inside * n.direction;
  return n;
}

double Chest::without_nipples(const Vector3d& x) const {
  double d = torso_.skin(x);
  for (const auto& b : breasts_) d = smooth_union(d, b.distance(x), fillet_mm);
  if (std::abs(d) > lumpy_mm) return d;
  return d + 2.2 * broad_(x) + 0.7 * fine_(x);
}

double Chest::nipple(const Vector3d& x) const {
  return std::min(nipples_[0].distance(x), nipples_[1].distance(x));
}

double Chest::outside(const Vector3d& x) const {
  return smooth_union(without_nipples(x), nipple(x), 4);
}

double Chest::front_y() const { return std::min(nipples_[0].tip().y(), nipples_[1].tip().y()); }

ColumnMap Chest::columns() const {
  ColumnMap c;
  const double reach = 175;
  c.step_x = c.step_z = column_mm;
  c.x0 = -reach, c.z0 = lower_mm;
  c.nx = static_cast<int>(2 * reach / column_mm) + 1;
  c.nz = static_cast<int>((upper_mm - lower_mm) / column_mm) + 1;
  c.thickness.assign(static_cast<std::size_t>(c.nx) * c.nz, 0);
  c.front.assign(c.thickness.size(), 1e9f);
  const double front = front_y() - 10;
  tbb::parallel_for(0, c.nz, [&](int k) {
    for (int i = 0; i < c.nx; ++i) {
      const double wall = std::min(torso_.wall_y(c.x(i), c.z(k)), 95.0);
      for (double y = wall, step; y > front; y -= step) {
        const double d = outside({c.x(i), y, c.z(k)});
        step = std::abs(d) > 2 * skipped_mm ? skipped_mm : depth_step_mm;
        if (d > 0) continue;
        c.at(c.thickness, i, k) += static_cast<float>(step);
        c.at(c.front, i, k) = static_cast<float>(y);
      }
    }
  });
  return c;
}

}  // namespace mammotwin
