#include "fitting/slab/grading.h"

#include <cmath>

namespace mammotwin {

namespace {

constexpr double steepest_slope = 0.8;  // density 0.6 to 1.4 from end to end

}  // namespace

Grading::Grading(double centre, double strength, double width, int columns)
    : centre_(centre), strength_(strength), width_(width) {
  total_ = integral(1);
  // ∫₀ᶜ slope (s − ½) ds = slope c (c − 1) / 2 moves the centre, and nothing at t = 1.
  const double here = integral(centre) / total_;
  const double line = std::round(here * columns) / columns;
  const double slope = (line - here) * total_ / (centre * (centre - 1) / 2);
  if (line > 0 && line < 1 && std::abs(slope) <= steepest_slope) slope_ = slope;
}

double Grading::integral(double t) const {
  constexpr double pi = 3.14159265358979;
  const double root = std::sqrt(2.0) * width_;
  const double bell = std::erf((t - centre_) / root) + std::erf(centre_ / root);
  return t + strength_ * width_ * std::sqrt(pi / 2) * bell;
}

double Grading::operator()(double t) const {
  return (integral(t) + slope_ * t * (t - 1) / 2) / total_;
}

double Grading::place(double w) const {
  double low = 0, high = 1;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = (low + high) / 2;
    ((*this)(middle) < w ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace mammotwin
