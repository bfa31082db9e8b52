#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/evaluate/calibration/calibrated_breast.h"
#include "pipeline/evaluate/calibration/womens_moves.h"

namespace mammotwin {

/// Of many breasts: means over the middle half of them; of the force's logarithm [log N], which
/// takes the place of a breast's, over that of the half that is pressed thinner and of the half
/// that stays thicker. Of an odd number the one in the middle is of both.
enum PopulationMean { kLogForceOfThin = kLogForce, kLogForceOfThick, kPopulationMeans };
using PopulationMeans = std::array<double, kPopulationMeans>;

/// What a figure of the breasts should be, and how far the mean of this many may lie from it.
struct CalibrationDatum {
  double target = 0, sd = 0;
};
using CalibrationData = std::array<CalibrationDatum, kPopulationMeans>;

/// The women's figures, and the logarithm of usual plate forces, which thin and thick breasts alike
/// are pressed with: 86 N (Helvie et al. 1994) to 116 N (the Norwegian programme). Standard
/// deviations are those of the women's figure and of `persons` breasts that vary as theirs do; of
/// the forces, half of what lies between the two usual ones.
CalibrationData calibration_data(const WomensMoves& women, int persons);

struct CalibratedNumber {
  TissueNumber number;
  double start = 0, value = 0;
  /// 95 % confidence limits; empty where the data do not decide it.
  std::optional<double> low, high;
  PopulationMeans slopes{};  ///< by its logarithm
};

struct Calibration {
  std::vector<CalibratedNumber> numbers;
  PopulationMeans start{}, end{};
  std::vector<BreastFigures> breasts;  ///< of each in the end
  std::string ended;                   ///< as Ceres says it
};

/// The numbers with which breasts do what women's do, as a population: their figures
/// come nearest to the data. Levenberg-Marquardt of Ceres on the numbers' logarithms, with
/// the solver's own slopes, `jobs` breasts at a time; `said` gets a line for each trial. All
/// `breasts` must have equilibria at the start (std::runtime_error else); a trial in which one has
/// none is refused.
Calibration calibrate_tissue(std::vector<CalibratedBreast>& breasts,
                             const std::vector<TissueNumber>& numbers, const CalibrationData& data,
                             int jobs, const std::function<void(const std::string&)>& said);

}  // namespace mammotwin
