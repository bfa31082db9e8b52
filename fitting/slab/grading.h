#pragma once

namespace mammotwin {

/// How densely columns of elements stand along one direction: a smooth map of [0,1] onto itself,
/// from a place in the flattened skin to the slab's coordinate, steep where elements are small.
///
///   w(t) ∝ ∫₀ᵗ 1 + slope (s − ½) + strength exp(−(s − centre)² / (2 width²)) ds
///
/// The slope is chosen so that `centre` falls on a line between two columns: a nipple stands on
/// nodes, whose cubics on both sides turn once each.
class Grading {
 public:
  Grading() = default;  ///< even columns: w = t
  /// 0 < centre < 1; where no gentle slope (density 0.6 to 1.4 from end to end) brings
  /// it on a line, it is left between lines.
  Grading(double centre, double strength, double width, int columns);

  double operator()(double t) const;
  double place(double w) const;  ///< the inverse

 private:
  double integral(double t) const;  ///< of the density without slope, from 0

  double centre_ = 0.5, strength_ = 0, width_ = 1, slope_ = 0, total_ = 1;
};

}  // namespace mammotwin
