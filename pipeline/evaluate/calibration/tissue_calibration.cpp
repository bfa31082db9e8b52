#include "pipeline/evaluate/calibration/tissue_calibration.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numeric>
#include <stdexcept>

#include "pipeline/evaluate/cases/evaluation_table.h"

namespace mammotwin {
namespace {

constexpr double kHelvie_N = 86, kNorway_N = 116;
constexpr int kMostIterations = 12;

std::vector<double> exponentials(const double* logs, std::size_t count) {
  std::vector<double> values(logs, logs + count);
  for (double& value : values) value = std::exp(value);
  return values;
}

std::string numbers_text(const std::vector<double>& values) {
  std::string text;
  char cell[32];
  for (const double value : values) {
    std::snprintf(cell, sizeof cell, " %.4g", value);
    text += cell;
  }
  return text;
}

/// The breasts' figures less the data, in standard deviations.
class PopulationMisfit : public ceres::CostFunction {
 public:
  PopulationMisfit(std::vector<CalibratedBreast>& breasts, const std::vector<TissueNumber>& numbers,
                   const CalibrationData& data, int jobs,
                   const std::function<void(const std::string&)>& said)
      : breasts_(breasts), numbers_(numbers), data_(data), jobs_(jobs), said_(said) {
    set_num_residuals(kPopulationMeans);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(numbers.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (!solve({parameters[0], parameters[0] + numbers_.size()})) return false;
    const PopulationMeans middle = middle_figures();
    for (int i = 0; i < kPopulationMeans; ++i)
      residuals[i] = (middle[i] - data_[i].target) / data_[i].sd;
    if (jacobians && jacobians[0]) {
      const auto slopes = middle_slopes();
      for (int i = 0; i < kPopulationMeans; ++i)
        for (std::size_t n = 0; n < numbers_.size(); ++n)
          jacobians[0][i * numbers_.size() + n] = slopes[n][i] / data_[i].sd;
    }
    return true;
  }

  /// At the last solved point.
  PopulationMeans middle_figures() const {
    PopulationMeans middle{};
    for (int i = 0; i < kPopulationMeans; ++i) {
      const std::vector<double> w = weights(i);
      for (std::size_t b = 0; b < breasts_.size(); ++b)
        middle[i] += w[b] * figures_[b][of_breast(i)];
    }
    return middle;
  }
  std::vector<PopulationMeans> middle_slopes() const {
    if (slopes_.empty()) {
      std::vector<std::vector<BreastFigures>> slopes(breasts_.size());
      work_through(breasts_.size(), jobs_,
                   [&](std::size_t b) { slopes[b] = breasts_[b].slopes(); });
      slopes_ = std::move(slopes);
    }
    std::vector<PopulationMeans> middle(numbers_.size(), PopulationMeans{});
    for (int i = 0; i < kPopulationMeans; ++i) {
      const std::vector<double> w = weights(i);
      for (std::size_t n = 0; n < numbers_.size(); ++n)
        for (std::size_t b = 0; b < breasts_.size(); ++b)
          middle[n][i] += w[b] * slopes_[b][n][of_breast(i)];
    }
    return middle;
  }
  const std::vector<BreastFigures>& figures() const { return figures_; }
  const std::string& reason() const { return reason_; }  ///< of the last refusal

  /// False, with the reason said, where a breast has no equilibrium.
  bool solve(const std::vector<double>& logs) const {
    if (logs == solved_at_) return true;
    const std::vector<double> values = exponentials(logs.data(), logs.size());
    std::vector<BreastFigures> figures(breasts_.size());
    solved_at_.clear();
    slopes_.clear();
    try {
      work_through(breasts_.size(), jobs_, [&](std::size_t b) {
        try {
          figures[b] = breasts_[b].solve(numbers_, values);
        } catch (const std::exception& error) {
          throw std::runtime_error(breasts_[b].name() + " " + error.what());
        }
      });
    } catch (const std::runtime_error& error) {
      reason_ = error.what();
      said_("numbers" + numbers_text(values) + ": refused, " + reason_);
      return false;
    }
    figures_ = figures;
    solved_at_ = logs;
    const PopulationMeans middle = middle_figures();
    said_("numbers" + numbers_text(values) +
          ": lateral, posterior, landmark, ribs [mm], log force of thin and of thick" +
          numbers_text({middle.begin(), middle.end()}));
    return true;
  }

 private:
  static int of_breast(int figure) { return std::min<int>(figure, kLogForce); }

  /// Breasts that a figure is of, thin ones first.
  std::vector<std::size_t> breasts_of(int figure) const {
    std::vector<std::size_t> all(breasts_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (figure < kLogForceOfThin) return all;
    std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
      return breasts_[a].thickness_mm() < breasts_[b].thickness_mm();
    });
    const std::size_t half = (all.size() + 1) / 2;
    if (figure == kLogForceOfThin) return {all.begin(), all.begin() + half};
    return {all.end() - half, all.end()};
  }

  /// Each breast's in the mean that a figure is.
  std::vector<double> weights(int figure) const {
    const std::vector<std::size_t> asked = breasts_of(figure);
    std::vector<double> values, all(breasts_.size(), 0.0);
    for (const std::size_t b : asked) values.push_back(figures_[b][of_breast(figure)]);
    const std::vector<double> of_asked = middle_half(values).weights;
    for (std::size_t k = 0; k < asked.size(); ++k) all[asked[k]] = of_asked[k];
    return all;
  }

  std::vector<CalibratedBreast>& breasts_;
  const std::vector<TissueNumber>& numbers_;
  const CalibrationData& data_;
  int jobs_;
  const std::function<void(const std::string&)>& said_;
  mutable std::vector<double> solved_at_;
  mutable std::vector<BreastFigures> figures_;
  mutable std::vector<std::vector<BreastFigures>> slopes_;  ///< empty: not asked for yet
  mutable std::string reason_;
};

/// 95 % limits of each number from the covariance of the logarithms.
void add_limits(ceres::Problem& problem, const std::vector<double>& logs,
                std::vector<CalibratedNumber>& numbers) {
  constexpr double two_sided_95 = 1.96;
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(options);
  const std::size_t count = logs.size();
  std::vector<double> block(count * count);
  const std::vector<std::pair<const double*, const double*>> blocks{{logs.data(), logs.data()}};
  if (!covariance.Compute(blocks, &problem) ||
      !covariance.GetCovarianceBlock(logs.data(), logs.data(), block.data()))
    return;
  for (std::size_t n = 0; n < count; ++n) {
    const double width = two_sided_95 * std::sqrt(block[n * count + n]);
    numbers[n].low = std::exp(logs[n] - width);
    numbers[n].high = std::exp(logs[n] + width);
  }
}

}  // namespace

CalibrationData calibration_data(const WomensMoves& women, int persons) {
  const auto datum = [&](const PopulationFigure& figure) {
    return CalibrationDatum{figure.middle,
                            figure.sd * std::sqrt(1.0 / figure.women + 1.0 / persons)};
  };
  const CalibrationDatum force{std::log(kHelvie_N * kNorway_N) / 2,
                               std::log(kNorway_N / kHelvie_N) / 2};
  return {datum(women.lateral),
          datum(women.posterior),
          datum(women.landmark),
          datum(women.ribs),
          force,
          force};
}

Calibration calibrate_tissue(std::vector<CalibratedBreast>& breasts,
                             const std::vector<TissueNumber>& numbers, const CalibrationData& data,
                             int jobs, const std::function<void(const std::string&)>& said) {
  Calibration result;
  std::vector<double> logs;
  for (const TissueNumber& number : numbers) {
    const double start = number.value(breasts.front().settings());
    result.numbers.push_back({number, start, start, {}, {}, {}});
    logs.push_back(std::log(start));
  }
  auto* misfit = new PopulationMisfit(breasts, numbers, data, jobs, said);
  ceres::Problem problem;
  problem.AddResidualBlock(misfit, nullptr, logs.data());
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    problem.SetParameterLowerBound(logs.data(), static_cast<int>(n), std::log(numbers[n].least));
    problem.SetParameterUpperBound(logs.data(), static_cast<int>(n), std::log(numbers[n].most));
  }
  if (!misfit->solve(logs)) throw std::runtime_error("at the start: " + misfit->reason());
  result.start = misfit->middle_figures();
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kMostIterations;
  options.initial_trust_region_radius = 1;  // of logarithms
  options.function_tolerance = 1e-3;
  options.parameter_tolerance = 1e-3;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.ended = summary.message;
  if (!misfit->solve(logs)) throw std::runtime_error("at the end: " + misfit->reason());
  result.end = misfit->middle_figures();
  result.breasts = misfit->figures();
  const auto slopes = misfit->middle_slopes();
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    result.numbers[n].value = std::exp(logs[n]);
    result.numbers[n].slopes = slopes[n];
  }
  add_limits(problem, logs, result.numbers);
  return result;
}

}  // namespace mammotwin
