#include "tests/registration/mammogram/raw_mammogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace mammotwin {
namespace {

struct Place {
  double depth, height;  // [mm] from the chest wall's edge, from the image's top
};

/// Mass attenuation [cm2/g] at 15, 20 and 30 keV (NIST, Hubbell and Seltzer 1995: ICRU-44 adipose
/// and breast tissue, skeletal muscle; water for skin) times density [g/cm3].
struct Tissue {
  std::array<double, 3> mass;
  double density;
};
constexpr Tissue kFat{{1.083, 0.5677, 0.3063}, 0.95}, kGland{{1.390, 0.6890, 0.3403}, 1.02},
    kSkin{{1.673, 0.8096, 0.3756}, 1.09}, kMuscle{{1.693, 0.8205, 0.3783}, 1.05};
constexpr double kSkin_mm = 1.5;
constexpr double kNippleRadius_mm = 5, kNippleOut_mm = 6;

/// [1/mm] by a power law between the two nearest energies.
double attenuation(const Tissue& tissue, double kev) {
  const int n = kev < 20 ? 0 : 1;
  const double low = n == 0 ? 15 : 20, high = n == 0 ? 20 : 30;
  const double share = std::log(kev / low) / std::log(high / low);
  return 0.1 * tissue.density *
         std::exp((1 - share) * std::log(tissue.mass[n]) + share * std::log(tissue.mass[n + 1]));
}

struct Line {
  double weight, fat, gland, skin, muscle;
};

/// Three energies for a spectrum behind a rhodium filter; harder with the tube's voltage.
std::array<Line, 3> spectrum(double kvp) {
  const double harder = 0.025 * (kvp - 28);
  std::array<Line, 3> lines;
  const std::array<double, 3> energies{17, 20, 24}, weights{0.35 - harder, 0.45, 0.2 + harder};
  for (int n = 0; n < 3; ++n)
    lines[n] = {weights[n], attenuation(kFat, energies[n]), attenuation(kGland, energies[n]),
                attenuation(kSkin, energies[n]), attenuation(kMuscle, energies[n])};
  return lines;
}

class Phantom {
 public:
  Phantom(const RawBreast& breast, double height_mm, unsigned seed)
      : b_(breast), centre_(breast.oblique ? 0.55 * height_mm : 0.5 * height_mm) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    for (Blob& blob : blobs_)
      blob = {{b_.depth_mm * (0.15 + 0.55 * share(random)),
               centre_ + b_.half_height_mm * (share(random) - 0.5)},
              5 + 12 * share(random),
              share(random)};
  }

  double centre() const { return centre_; }

  /// Depth inside the skin, negative outside [mm]: to first order, so exact at the skin.
  double inside(const Place& x) const {
    const bool upper = b_.oblique && x.height < centre_;  // goes on beyond the image's top
    const double half =
        upper ? std::max(1.7 * b_.half_height_mm, 1.3 * centre_) : b_.half_height_mm;
    const double p = x.depth / b_.depth_mm, q = (x.height - centre_) / half;
    const double rho = std::hypot(p, q);
    if (rho < 1e-6) return b_.depth_mm;
    return (1 - rho) * rho / std::hypot(p / b_.depth_mm, q / half);
  }

  double transmission(const Place& x, const std::array<Line, 3>& lines) const {
    const double all = chord(inside(x), b_.thickness_mm, b_.rim_share * b_.thickness_mm);
    if (all == 0 && nipple(x) == 0) return 1;
    const double inner_thickness = b_.thickness_mm - 2 * kSkin_mm;
    const double inner =
        std::min(all, chord(inside(x) - kSkin_mm, inner_thickness, b_.rim_share * inner_thickness));
    const double skin = std::max(all - inner, nipple(x));
    const double muscle = b_.oblique && x.depth < muscle_edge(x.height) ? 0.8 * inner : 0;
    const double gland = gland_share(x) * (inner - muscle), fat = inner - muscle - gland;
    double sum = 0;
    for (const Line& l : lines)
      sum +=
          l.weight * std::exp(-l.fat * fat - l.gland * gland - l.skin * skin - l.muscle * muscle);
    return sum;
  }

  double filled(const Place& x) const {
    return chord(inside(x), b_.thickness_mm, b_.rim_share * b_.thickness_mm) / b_.thickness_mm;
  }

 private:
  struct Blob {
    Place centre;
    double radius, share;
  };

  /// Thickness of a plate with a round rim `deep` mm inside its edge.
  static double chord(double deep, double thickness, double rim) {
    if (deep <= 0) return 0;
    if (deep >= rim) return thickness;
    return thickness * std::sqrt(1 - std::pow(1 - deep / rim, 2));
  }
  double nipple(const Place& x) const {
    const double out = (x.depth - b_.depth_mm) / kNippleOut_mm;
    const double across = (x.height - centre_) / kNippleRadius_mm;
    const double left = 1 - across * across - std::max(0., out) * std::max(0., out);
    if (left <= 0 || x.depth < b_.depth_mm - kNippleOut_mm) return 0;
    return 2 * kNippleRadius_mm * std::sqrt(left);
  }
  double muscle_edge(double height) const {
    return 0.55 * b_.depth_mm * (1 - height / (0.95 * centre_));
  }
  double gland_share(const Place& x) const {
    double sum = 0;
    for (const Blob& blob : blobs_)
      sum += blob.share * std::exp(-(std::pow(x.depth - blob.centre.depth, 2) +
                                     std::pow(x.height - blob.centre.height, 2)) /
                                   (2 * blob.radius * blob.radius));
    return b_.gland * std::min(1., sum);
  }

  RawBreast b_;
  double centre_;
  std::array<Blob, 12> blobs_;
};

/// Scatter behind a grid: what the breast lets through, wide.
class Scatter {
 public:
  Scatter(const Phantom& phantom, const std::array<Line, 3>& lines, double depth, double height)
      : columns_(static_cast<int>(depth / kStep) + 1),
        rows_(static_cast<int>(height / kStep) + 1),
        values_(columns_ * rows_) {
    constexpr double kToPrimary = 0.15;
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const Place x{c * kStep, r * kStep};
        values_[r * columns_ + c] = kToPrimary * phantom.filled(x) * phantom.transmission(x, lines);
      }
    constexpr int kPasses = 3, kReach = 4;  // boxes of 18 mm, thrice: nearly a Gauss curve
    for (int pass = 0; pass < kPasses; ++pass) {
      blur(kReach, 1, columns_, rows_, columns_);
      blur(kReach, columns_, rows_, columns_, 1);
    }
  }
  double at(const Place& x) const {
    const int c = std::clamp<int>(std::lround(x.depth / kStep), 0, columns_ - 1);
    const int r = std::clamp<int>(std::lround(x.height / kStep), 0, rows_ - 1);
    return values_[r * columns_ + c];
  }

 private:
  static constexpr double kStep = 2;

  void blur(int reach, int step, int count, int lines, int line_step) {
    std::vector<double> line(count);
    for (int l = 0; l < lines; ++l) {
      for (int i = 0; i < count; ++i) {
        double sum = 0;
        for (int j = std::max(0, i - reach); j <= std::min(count - 1, i + reach); ++j)
          sum += values_[l * line_step + j * step];
        line[i] = sum / (2 * reach + 1);
      }
      for (int i = 0; i < count; ++i) values_[l * line_step + i * step] = line[i];
    }
  }

  int columns_, rows_;
  std::vector<double> values_;
};

/// Share of the beam that a collimator at `covered` mm lets through `at` mm from the image's edge;
/// its shadow is a millimetre wide.
double shutter(double at, double covered) {
  constexpr double kShadow_mm = 1, kLeak = 5e-4;
  if (covered <= 0) return 1;
  return std::clamp((at - covered) / kShadow_mm + 0.5, kLeak, 1.);
}

/// Lead letters in the far upper corner, as a technologist puts them.
bool is_lead(const Place& x, double depth, double top) {
  const double right = depth - 20 - x.depth, down = x.height - top - 12;
  return right > 0 && right < 24 && down > 0 && down < 9 && std::fmod(right, 7) < 4;
}

std::uint16_t stored(double counts, const RawExposure& e) {
  const double most = std::pow(2, e.bits) - 1, most_counts = std::pow(2, e.converter_bits) - 1;
  counts = std::clamp(std::round(counts), 0., most_counts);
  double value = e.logarithmic ? most * std::log1p(counts) / std::log1p(most_counts) : counts;
  if (e.more_is_darker) value = most - value;
  return static_cast<std::uint16_t>(std::lround(value));
}

}  // namespace

RawMammogram raw_mammogram(const RawBreast& breast, const RawExposure& e) {
  RawMammogram raw{breast, e, {}};
  const double depth = e.columns * e.pixel_mm, height = e.rows * e.pixel_mm;
  const Phantom phantom(breast, height, e.seed);
  const auto lines = spectrum(e.kvp);
  const Scatter scatter(phantom, lines, depth, height);
  std::mt19937 random(e.seed);
  std::normal_distribution<double> noise;
  raw.values.reserve(static_cast<std::size_t>(e.columns) * e.rows);
  for (int row = 0; row < e.rows; ++row)
    for (int column = 0; column < e.columns; ++column) {
      const int from_wall = e.wall_right ? e.columns - 1 - column : column;
      const Place x{(from_wall + 0.5) * e.pixel_mm, (row + 0.5) * e.pixel_mm};
      const double s = x.depth / depth, across = 2 * x.height / height - 1;
      const double beam = (1 - e.heel * (0.7 * s + 0.3 * s * s)) * (1 - 0.03 * across * across) *
                          shutter(x.depth, e.wall_mm) * shutter(depth - x.depth, e.far_mm) *
                          shutter(x.height, e.top_mm) * shutter(height - x.height, e.bottom_mm);
      const double through =
          is_lead(x, depth - e.far_mm, e.top_mm) ? 1e-3 : phantom.transmission(x, lines);
      const double counts = e.open_counts * beam * (through + scatter.at(x));
      const double sd = std::hypot(std::sqrt(counts), e.electronic_noise);
      raw.values.push_back(stored(e.dark_counts + counts + sd * noise(random), e));
    }
  return raw;
}

namespace {

Place place_of(const RawExposure& e, double column, double row) {
  const double from_wall = e.wall_right ? e.columns - 1 - column : column;
  return {(from_wall + 0.5) * e.pixel_mm, (row + 0.5) * e.pixel_mm};
}

}  // namespace

double RawMammogram::outside_mm(double column, double row) const {
  const Phantom phantom(breast, exposure.rows * exposure.pixel_mm, exposure.seed);
  return -phantom.inside(place_of(exposure, column, row));
}

double RawMammogram::nipple_column() const {
  const double from_wall = (breast.depth_mm + kNippleOut_mm) / exposure.pixel_mm - 0.5;
  return exposure.wall_right ? exposure.columns - 1 - from_wall : from_wall;
}

double RawMammogram::nipple_row() const {
  const Phantom phantom(breast, exposure.rows * exposure.pixel_mm, exposure.seed);
  return phantom.centre() / exposure.pixel_mm - 0.5;
}

bool RawMammogram::is_exposed(double column, double row, double margin_mm) const {
  const RawExposure& e = exposure;
  const Place x = place_of(e, column, row);
  const double depth = e.columns * e.pixel_mm, height = e.rows * e.pixel_mm;
  return x.depth > e.wall_mm + margin_mm && x.depth < depth - e.far_mm - margin_mm &&
         x.height > e.top_mm + margin_mm && x.height < height - e.bottom_mm - margin_mm;
}

}  // namespace mammotwin
