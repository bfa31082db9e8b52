#pragma once

#include <algorithm>

#include "registration/search/view_match.h"

namespace mammotwin {

/// How far tissue lies from where the best state puts it, as what is left after a search tells it:
/// standard deviations on the detector, in each direction [mm]. All three measure the same field of
/// displacements, so the largest counts. It is added to a lesion's covariance and does not fade as
/// evidence grows, unlike a factor on the evidence's own variances: a wrong model is wrong however
/// many points of outline say so.
struct ModelDiscrepancy {
  /// Of the outline's RMS r beyond the sd s = 2 mm with which it was weighed: sqrt(r^2 - s^2); at
  /// least r over the 90 % ellipse's semi-axis in sds, with which none is narrower than the outline
  /// is off.
  double outline_mm = 0;
  /// Of the nipple's distance d beyond its own sd s each way: sqrt(d^2 / 2 - s^2); none within
  /// sqrt(2 ln 20) s, where 95 % of the nipples lie that are found with that sd.
  double nipple_mm = 0;
  /// Errors of sd e each way smear a pattern whose autocorrelation is exp(-d^2 / (2 l^2)) to a
  /// correlation c0 / (1 + e^2 / l^2), c0 being that of the same breast in place: e = l sqrt(c0 / c
  /// - 1), none above c0. 0.95: chosen on drawn patients with even numbers, of another tissue, so
  /// that the ellipses of both kinds hold about the marks that they should (docs/theory.md); of
  /// them the best correlate by 0.96. Without a pattern to compare, kUncorrectedSd_mm.
  double pattern_mm = 0;
  /// How much further the views, each searched alone, put tissue from where both put it than their
  /// covariances say.
  double views_mm = 0;

  double sd_mm() const { return std::max({outline_mm, nipple_mm, pattern_mm, views_mm}); }
};

/// Of a prediction whose inner tissue no mammogram shows. Mean and sd of the distances that methods
/// with finite elements left on real patients after registering them to their mammograms: CC 5.65
/// +- 2.76 and MLO 7.83 +- 3.04 (Garcia 2019), 11.6 +- 3.8 and 11.0 +- 5.4 (Mertzanidou 2014), 4.2
/// +- 1.9 and 4.8 +- 1.3 mm (Solves-Llorens 2014). Root mean square of their six sqrt((mean^2 +
/// sd^2) / 2).
inline constexpr double kUncorrectedSd_mm = 6.2;

ModelDiscrepancy model_discrepancy(const MatchFigures& left);

/// Of a prediction that no mammogram corrects [mm]: kUncorrectedSd_mm, and as far as the nipple
/// swung, a roll moved what lies at a plate and tissue slid back, for a radiographer lets no breast
/// escape.
double uncorrected_sd_mm(const PlateEscape& escape, double thickness_mm);

}  // namespace mammotwin
