#include "pipeline/evaluate/compression/outline_population.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

#include "registration/export/csv.h"

namespace mammotwin {
namespace {

constexpr int kAngles = 256, kHeights = 30, kComponents = 15;
constexpr double kUnit_mm = 200;  // radii are stored as fractions of this
// First score of a thickness, from the publication's own generator.
constexpr double kScorePerMm = 3.1988, kScoreAtZero = -194.0606;

Eigen::MatrixXd read_table(const std::filesystem::path& path, int rows, int columns) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  Eigen::MatrixXd table(rows, columns);
  std::string line;
  for (int row = 0; row < rows; ++row) {
    std::getline(in, line);
    const std::vector<std::string> cells = csv::cells(line);
    if (!in || static_cast<int>(cells.size()) != columns)
      throw std::runtime_error(path.string() + ": line " + std::to_string(row + 1) + " has not " +
                               std::to_string(columns) + " numbers");
    for (int column = 0; column < columns; ++column)
      table(row, column) = csv::number(cells[column], path.filename().string());
  }
  return table;
}

/// The last row holds heights and is left out.
Eigen::MatrixXd read_radii(const std::filesystem::path& path) {
  return kUnit_mm * read_table(path, kAngles + 1, kHeights).topRows(kAngles);
}

}  // namespace

OutlinePopulation::OutlinePopulation(const std::filesystem::path& folder)
    : mean_(read_radii(folder / "PCAmean.csv")) {
  for (int i = 1; i <= kComponents; ++i)
    components_.push_back(read_radii(folder / ("PCA" + std::to_string(i) + ".csv")));
  const Eigen::MatrixXd scores = read_table(folder / "PCA_normal_fit.csv", kComponents, 2);
  score_mean_ = scores.col(0);
  score_sd_ = scores.col(1);
}

Eigen::MatrixXd OutlinePopulation::mean_at(double thickness_mm) const {
  if (!(thickness_mm >= kThinnest_mm && thickness_mm <= kThickest_mm))
    throw std::invalid_argument("the population has no breasts of " + std::to_string(thickness_mm) +
                                " mm; expected 30 to 90 mm");
  Eigen::MatrixXd radius = mean_ + (kScorePerMm * thickness_mm + kScoreAtZero) * components_[0];
  for (int i = 1; i < kComponents; ++i) radius += score_mean_[i] * components_[i];
  return radius;
}

OutlinePopulation::Radius OutlinePopulation::at(double thickness_mm, double angle_deg) const {
  const int row = static_cast<int>(std::lround((angle_deg + 90) / 180 * (kAngles - 1)));
  Eigen::Index height;
  const double mean = mean_at(thickness_mm).row(row).maxCoeff(&height);
  double variance = 0;
  for (int i = 1; i < kComponents; ++i)
    variance += std::pow(score_sd_[i] * components_[i](row, height), 2);
  return {mean, std::sqrt(variance)};
}

// Sectors of a circle at evenly spaced heights.
double OutlinePopulation::volume_ml(double thickness_mm) const {
  const double sector = std::numbers::pi / (kAngles - 1);
  const double area = 0.5 * sector * mean_at(thickness_mm).squaredNorm() / kHeights;
  return area * thickness_mm / 1000;
}

double OutlinePopulation::typical_thickness_mm(double volume_ml) const {
  double low = kThinnest_mm, high = kThickest_mm;
  while (high - low > 0.01) {
    const double middle = (low + high) / 2;
    (this->volume_ml(middle) < volume_ml ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace mammotwin
