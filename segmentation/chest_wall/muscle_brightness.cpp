#include "segmentation/chest_wall/muscle_brightness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mammotwin {
namespace {

constexpr int num_bins = 72;
constexpr double darkest = 0.08, brightest = 6;  // of fat
constexpr double muscle_mm = 13;                 // pectoral and what lies between the ribs
constexpr int clear_below_skin_mm = 8;
constexpr int before_mm = 45, behind_mm = 45;  // of the usual wall: what is looked at
constexpr int rounds = 30;
constexpr double least_samples = 2000;

enum Tissue { breast, muscle, behind, num_tissues };
using Histogram = std::array<double, num_bins>;
using Shares = std::array<double, num_tissues>;

struct Sample {
  int bin;
  Shares prior;
};

int bin_of(float intensity) {
  static const double low = std::log(darkest), width = std::log(brightest / darkest) / num_bins;
  return std::clamp(static_cast<int>((std::log(intensity) - low) / width), 0, num_bins - 1);
}

double brightness_of(double bin) {
  return darkest * std::pow(brightest / darkest, (bin + 0.5) / num_bins);
}

/// At a radius, where the wall lies normally distributed.
Shares prior_at(double radius_mm, const UsualRadius& usual) {
  const auto wall_below = [&](double r) {
    return 0.5 * std::erfc(-(r - usual.mean) / (std::numbers::sqrt2 * usual.spread));
  };
  const double in_breast = wall_below(radius_mm), before_end = wall_below(radius_mm + muscle_mm);
  return {in_breast, before_end - in_breast, 1 - before_end};
}

std::vector<Sample> samples_of(const PolarRays& rays, const PectoralWall& grid,
                               const std::vector<UsualRadius>& usual, double z_low, double z_high) {
  std::vector<Sample> samples;
  for (const Side side : {Side::left, Side::right})
    for (const std::size_t n : grid.rays_before(side, z_low, z_high, breastbone_degrees)) {
      if (!(usual[n].spread > 0)) continue;
      const int at = static_cast<int>(usual[n].mean - PolarRays::least_radius_mm);
      const int last = std::min(at + before_mm, rays.exit[n] - clear_below_skin_mm);
      for (int d = std::max(0, at - behind_mm); d < last; ++d)
        samples.push_back(
            {bin_of(rays.ray(n)[d]), prior_at(PolarRays::least_radius_mm + d, usual[n])});
    }
  return samples;
}

/// A bin takes a quarter from each neighbour: few samples make no peak.
Histogram smoothed(const Histogram& raw) {
  Histogram out{};
  double sum = 0;
  for (int b = 0; b < num_bins; ++b) {
    out[b] = raw[b] / 2 + raw[std::max(0, b - 1)] / 4 + raw[std::min(num_bins - 1, b + 1)] / 4;
    sum += out[b];
  }
  for (double& value : out) value /= std::max(sum, 1e-300);
  return out;
}

std::array<Histogram, num_tissues> explained(const std::vector<Sample>& samples) {
  std::array<Histogram, num_tissues> tissue;
  for (Histogram& h : tissue) h.fill(1.0 / num_bins);
  for (int round = 0; round < rounds; ++round) {
    std::array<Histogram, num_tissues> raw{};
    for (const Sample& s : samples) {
      double all = 1e-300;
      for (int t = 0; t < num_tissues; ++t) all += s.prior[t] * tissue[t][s.bin];
      for (int t = 0; t < num_tissues; ++t) raw[t][s.bin] += s.prior[t] * tissue[t][s.bin] / all;
    }
    for (int t = 0; t < num_tissues; ++t) tissue[t] = smoothed(raw[t]);
  }
  return tissue;
}

}  // namespace

double learnt_muscle(const PolarRays& rays, const PectoralWall& grid,
                     const std::vector<UsualRadius>& usual, double z_low, double z_high) {
  const std::vector<Sample> samples = samples_of(rays, grid, usual, z_low, z_high);
  double of_muscle = 0;
  for (const Sample& s : samples) of_muscle += s.prior[muscle];
  if (of_muscle < least_samples) return 0;
  const Histogram found = explained(samples)[muscle];
  const auto peak = std::max_element(found.begin(), found.end()) - found.begin();
  constexpr int around = 2;
  double sum = 0, weights = 0;
  for (auto b = std::max<std::ptrdiff_t>(0, peak - around);
       b <= std::min<std::ptrdiff_t>(num_bins - 1, peak + around); ++b)
    sum += found[b] * static_cast<double>(b), weights += found[b];
  return brightness_of(sum / weights);
}

}  // namespace mammotwin
