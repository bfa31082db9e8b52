#include "pipeline/validation/other_fits/stiffness_fits.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "fitting/mesh/block_mesh.h"
#include "solver/gravity/fit_stiffness.h"

namespace mammotwin {
namespace {

constexpr double kHalfWidth_mm = 45, kHeight_mm = 45;
constexpr double kGravity = 9810;     // [mm/s²]
constexpr double kHeavy = 60;         // times its weight: no rest with its stiffness as set
constexpr double kDifference = 0.02;  // of ln factor: what fit_stiffness ends at

/// Fat that hangs along +z from the chest wall at z = 0, with skin all round, of `weight` times its
/// own weight.
BreastProblem hanging_block(double weight) {
  BreastProblem problem;
  const Eigen::Vector3d low(-kHalfWidth_mm, -kHalfWidth_mm, 0);
  const Eigen::Vector3d high(kHalfWidth_mm, kHalfWidth_mm, kHeight_mm);
  problem.mesh.mesh = block_mesh(low, high, {2, 2, 1});
  for (int e = 0; e < problem.mesh.mesh.num_elements(); ++e) {
    const bool right = e % 2 == 1, upper = e / 2 == 1;
    FaceLabels labels;
    labels.fill(FaceLabel::interior);
    labels[right ? 1 : 0] = labels[upper ? 3 : 2] = labels[5] = FaceLabel::skin;
    labels[4] = FaceLabel::chest_wall;
    problem.mesh.faces.push_back(labels);
  }
  problem.tissue = [](const Eigen::Vector3d&, double) { return std::array<double, 3>{1, 0, 0}; };
  problem.gravity = {0, 0, weight * kGravity};
  return problem;
}

std::vector<HermiteMesh::Node> on_its_back(BreastProblem prone, double factor) {
  UnloadOptions options;
  options.check = false;
  prone.gravity /= factor;
  const UnloadResult unloaded = unload(prone, options);
  if (!unloaded.report.usable()) return {};
  BreastProblem supine = from_unloaded(prone, unloaded.unloaded);
  supine.gravity = -prone.gravity;
  const HangResult state = hang(supine, {});
  return state.report.usable() ? state.deformed : std::vector<HermiteMesh::Node>{};
}

/// Where the nodes of a block made with `factor` were seen, each `error_mm` (standard deviation)
/// off along every axis.
std::vector<Eigen::Vector3d> seen_places(const BreastProblem& prone, double factor,
                                         double error_mm) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<Eigen::Vector3d> places;
  for (const HermiteMesh::Node& node : on_its_back(prone, factor)) {
    Eigen::Vector3d place = node.col(0);
    for (double& x : place) x += error_mm * normal(random);
    places.push_back(place);
  }
  if (places.empty()) throw std::runtime_error("the block that is to be seen finds no rest");
  return places;
}

std::vector<double> distances(const std::vector<HermiteMesh::Node>& nodes,
                              const std::vector<Eigen::Vector3d>& places) {
  std::vector<double> result;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    result.push_back((nodes[n].col(0) - places[n]).norm());
  return result;
}

double rms(const std::vector<double>& values) {
  double squares = 0;
  for (double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

class FactorCost : public ceres::CostFunction {
 public:
  FactorCost(const DistancesAtFactor& distances, int points, int& trials)
      : distances_(distances), trials_(trials) {
    set_num_residuals(points);
    mutable_parameter_block_sizes()->push_back(1);
  }

  bool Evaluate(const double* const* log_factor, double* residuals,
                double** jacobians) const override {
    const std::vector<double> here = at(*log_factor[0]);
    if (here.empty()) return false;
    std::copy(here.begin(), here.end(), residuals);
    if (!jacobians || !jacobians[0]) return true;
    const std::vector<double> there = at(*log_factor[0] + kDifference);
    for (std::size_t i = 0; i < there.size(); ++i)
      jacobians[0][i] = (there[i] - here[i]) / kDifference;
    return !there.empty();
  }

 private:
  std::vector<double> at(double log_factor) const {
    ++trials_;
    return distances_(std::exp(log_factor));
  }

  const DistancesAtFactor& distances_;
  int& trials_;
};

struct Seen {
  const char* name;
  double error_mm = 0, weight = 1;
};

nlohmann::json or_null(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json fitted_ways(const Seen& seen, double true_factor) {
  const BreastProblem prone = hanging_block(seen.weight);
  const auto places = seen_places(prone, true_factor, seen.error_mm);
  const StiffnessFit golden = fit_stiffness(
      prone, -prone.gravity, [&](const auto& nodes) { return rms(distances(nodes, places)); }, {});
  const DistancesAtFactor at = [&](double factor) {
    return distances(on_its_back(prone, factor), places);
  };
  const FactorByCeres free = factor_by_ceres(at, false), bounded = factor_by_ceres(at, true);
  return {{"name", seen.name},
          {"true_factor", true_factor},
          {"factor", golden.factor},
          {"trials", golden.trials},
          {"ceres_factor", or_null(free.factor)},
          {"ceres_trials", free.trials},
          {"ceres_bounded_factor", or_null(bounded.factor)},
          {"ceres_bounded_trials", bounded.trials}};
}

}  // namespace

FactorByCeres factor_by_ceres(const DistancesAtFactor& distances, bool bounded) {
  FactorByCeres found;
  const int points = static_cast<int>(distances(1).size());
  if (points == 0) return found;  // Ceres starts from nothing that cannot be evaluated
  double log_factor = 0;
  ceres::Problem problem;
  problem.AddResidualBlock(new FactorCost(distances, points, found.trials), nullptr, &log_factor);
  if (bounded) {
    problem.SetParameterLowerBound(&log_factor, 0, std::log(0.1));
    problem.SetParameterUpperBound(&log_factor, 0, std::log(10));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.initial_trust_region_radius = 1;  // of four tried the one with the fewest trials
  options.function_tolerance = 1e-3;
  options.parameter_tolerance = kDifference / 2;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  found.factor = std::exp(log_factor);
  return found;
}

nlohmann::json stiffness_fits() {
  nlohmann::json cases = nlohmann::json::array();
  for (const Seen& seen : {Seen{"seen exactly"}, Seen{"seen with errors of 1 mm", 1}})
    for (const double factor : {0.3, 0.6, 1.5, 4.0}) cases.push_back(fitted_ways(seen, factor));
  for (const double factor : {4.0, 8.0})
    cases.push_back(fitted_ways({"no rest at factor 1", 0, kHeavy}, factor));
  return {{"cases", cases}};
}

}  // namespace mammotwin
