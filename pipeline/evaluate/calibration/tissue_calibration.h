#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/evaluate/calibration/calibrated_breast.h"
#include "pipeline/evaluate/calibration/womens_moves.h"

namespace mammotwin {

/// What a figure of the breasts should be, and how far the mean of this many may lie from it.
struct CalibrationDatum {
  double target = 0, sd = 0;
};

/// The women's figures, and the logarithm of usual plate forces: 86 N (Helvie et al. 1994) to 116 N
/// (the Norwegian programme). Standard deviations are those of the women's figure and of `persons`
/// breasts that vary as theirs do; of the force, half of what lies between the two usual ones.
std::array<CalibrationDatum, kBreastFigures> calibration_data(const WomensMoves& women,
                                                              int persons);

struct CalibratedNumber {
  TissueNumber number;
  double start = 0, value = 0;
  /// 95 % confidence limits; empty where the data do not decide it.
  std::optional<double> low, high;
  std::array<double, kBreastFigures> slopes{};  ///< of the figures, by its logarithm
};

struct Calibration {
  std::vector<CalibratedNumber> numbers;
  BreastFigures start{}, end{};        ///< middle halves of the breasts
  std::vector<BreastFigures> breasts;  ///< of each in the end
  std::string ended;                   ///< as Ceres says it
};

/// The numbers with which breasts do what women's do, as a population: the middle halves of their
/// figures come nearest to the data. Levenberg-Marquardt of Ceres on the numbers' logarithms, with
/// the solver's own slopes, `jobs` breasts at a time; `said` gets a line for each trial. All
/// `breasts` must have equilibria at the start (std::runtime_error else); a trial in which one has
/// none is refused.
Calibration calibrate_tissue(std::vector<CalibratedBreast>& breasts,
                             const std::vector<TissueNumber>& numbers,
                             const std::array<CalibrationDatum, kBreastFigures>& data, int jobs,
                             const std::function<void(const std::string&)>& said);

}  // namespace mammotwin
