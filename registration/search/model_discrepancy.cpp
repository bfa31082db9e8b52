#include "registration/search/model_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "registration/search/search_ellipse.h"
#include "registration/search/search_verdict.h"

namespace mammotwin {
namespace {

const double kNinety = semi_axis_in_sd(0.9);
// Independent pieces of pattern are kPatternPiece_mm wide: that is pi l^2 for this autocorrelation.
const double kPatternLength_mm = kPatternPiece_mm / std::sqrt(M_PI);

constexpr double kInPlace = 0.95;
const double kExplained = std::sqrt(2 * std::log(20));  // sds that hold 95 % in the plane

double root_beyond(double squared, double expected) {
  return std::sqrt(std::max(0.0, squared - expected * expected));
}

}  // namespace

double uncorrected_sd_mm(const PlateEscape& escape, double thickness_mm) {
  const double rolled_mm = std::sin(escape.roll_deg * std::numbers::pi / 180) * thickness_mm / 2;
  return std::hypot(std::hypot(kUncorrectedSd_mm, escape.swing_mm, rolled_mm), escape.slid_mm);
}

ModelDiscrepancy model_discrepancy(const MatchFigures& left) {
  ModelDiscrepancy d;
  const double r = left.outline_rms_mm;
  d.outline_mm = std::max(root_beyond(r * r, kOutlineSd_mm), r / kNinety);
  if (left.nipple_mm && *left.nipple_mm > kExplained * left.nipple_sd_mm)
    d.nipple_mm = root_beyond(*left.nipple_mm * *left.nipple_mm / 2, left.nipple_sd_mm);
  d.pattern_mm = kUncorrectedSd_mm;
  if (left.pattern_correlation) {
    const double c = std::max(no_registration::kCorrelation, *left.pattern_correlation);
    d.pattern_mm = kPatternLength_mm * std::sqrt(std::max(0.0, kInPlace / c - 1));
  }
  return d;
}

}  // namespace mammotwin
