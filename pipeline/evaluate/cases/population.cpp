#include "pipeline/evaluate/cases/population.h"

#include <cmath>
#include <cstdio>

#include "pipeline/synthesize/counter_random.h"

namespace mammotwin {
namespace {

constexpr std::uint64_t population_seed = 20052;
constexpr int hard_every = 4;
constexpr double voxel_mm = 1.5;  // a quadrature point of a 6x6x2 mesh stands for some 5 mm

double log_uniform(CounterRandom& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

std::string name_of_number(int number) {
  char name[32];
  std::snprintf(name, sizeof name, "synthetic-%03d", number);
  return name;
}

/// What the law promises of each breast and its views.
void draw_task(CounterRandom random, SyntheticBreast& b) {
  AnatomyOptions& a = b.patient.anatomy;
  a.side = random.bits() & 1 ? Side::left : Side::right;
  a.volume_ml = log_uniform(random, 150, 1500);
  a.density = random.uniform(0.05, 0.6);
  a.ptosis = random.uniform(0, 1);
  a.lesions = 1 + static_cast<int>(random.uniform(0, 3));
  b.stiffness_ratio = log_uniform(random, b.hard ? 5 : 1, 10);
  // 0.605: the thickness asked is rounded, and the measured one may be off by 0.1 of 60 mm.
  b.cc_fraction = random.uniform(b.hard ? 0.605 : 0.25, 0.76);
  b.mlo_fraction = random.uniform(b.hard ? 0.605 : 0.25, 0.76);
  b.patient.views.mlo_angle_deg = random.uniform(30, 60);
}

/// The chest and the shape of the breast on it. Large breasts come with more fat beside them.
void draw_build(CounterRandom random, AnatomyOptions& a) {
  const double size = std::log(a.volume_ml / 150) / std::log(10.0);  // 0 to 1
  a.seed = random.bits() >> 33;  // within the range of mammotwin-synthesize --seed
  a.chest_half_width_mm = random.uniform(120, 160);
  a.chest_roundness = random.uniform(0.6, 0.8);
  a.projection = random.uniform(1, 1.9);
  a.asymmetry = random.uniform(-0.2, 0.2);
  a.skin_mm = random.uniform(1, 2.5);
  a.subcutaneous_mm = random.uniform(8, 10 + 12 * size);
  a.pectoral_mm = random.uniform(10, 22);
  a.lesion_min_mm = 8;
  a.lesion_max_mm = random.uniform(8, 10 + 8 * size);
}

}  // namespace

SyntheticBreast draw_breast(int number, int attempt) {
  SyntheticBreast b;
  b.number = number;
  b.name = name_of_number(number);
  b.hard = number % hard_every == 0;
  b.patient.scan.voxel_mm = voxel_mm;
  draw_task(CounterRandom(population_seed, number), b);
  constexpr std::uint64_t attempts_kept_apart = 1000;
  draw_build(CounterRandom(population_seed + 1, number * attempts_kept_apart + attempt),
             b.patient.anatomy);
  return b;
}

}  // namespace mammotwin
