#include "pipeline/validation/other_fits/skin_slab_fits.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace mammotwin {
namespace {

constexpr double kVoxel_mm = 1.2;
constexpr int kSkins = 200;  // of each kind
// Thickness [mm] and level over fat: thin, usual and thick, bright and dark.
constexpr std::pair<double, double> kStarts[] = {{0.8, 2},   {1.5, 2},   {3, 2},
                                                 {0.8, 0.5}, {1.5, 0.5}, {3, 0.5}};
constexpr double kNoiseLength_mm = 1;  // over which a profile's noise hangs together
constexpr double kDepthStep_mm = 0.25;
enum Number { thickness, surface, blur, level, fat, slope, numbers };

DrawnSkin skin_of(const double* z) {
  return {z[thickness], z[surface], z[blur], z[level], z[fat], z[slope]};
}

double value_at(double depth, const DrawnSkin& skin, double voxel_mm) {
  const double width = std::sqrt(2.0) * skin.blur * voxel_mm;
  const double end = skin.surface + skin.thickness;
  const double outer = 0.5 * std::erfc((skin.surface - depth) / width);
  const double inner = 0.5 * std::erfc((end - depth) / width);
  return skin.level * (outer - inner) +
         inner * (skin.fat + skin.slope * std::max(0.0, depth - end));
}

/// What is left of a profile, of a usual slope and, if asked, of a usual thickness, each over its
/// standard deviation.
struct Left {
  const SkinProfile& profile;
  double voxel_mm, noise;
  bool usual;

  int size() const { return static_cast<int>(profile.depth.size()) + 2; }

  bool operator()(const double* z, double* residuals) const {
    const std::size_t values = profile.depth.size();
    const double weight =
        std::sqrt(independent_profile_values / static_cast<double>(values)) / noise;
    for (std::size_t i = 0; i < values; ++i)
      residuals[i] = weight * (value_at(profile.depth[i], skin_of(z), voxel_mm) - profile.value[i]);
    residuals[values] = z[slope] / usual_fat_slope;
    residuals[values + 1] =
        usual ? std::log(z[thickness] / usual_skin_mm) / std::log(usual_skin_factor) : 0;
    return true;
  }
};

void bound(ceres::Problem& problem, double* z) {
  const auto between = [&](Number number, double low, double high) {
    problem.SetParameterLowerBound(z, number, low);
    problem.SetParameterUpperBound(z, number, high);
  };
  between(thickness, thinnest_measured_skin_mm, thickest_measured_skin_mm);
  between(surface, -0.8, 0.8);
  between(blur, 0.4, 0.9);
  problem.SetParameterLowerBound(z, level, 0);
  problem.SetParameterLowerBound(z, fat, 0);
}

/// The drawn skin's profile with noise that hangs together over a millimetre.
SkinProfile noisy_profile(const DrawnSkin& skin, double noise, std::mt19937& random) {
  std::normal_distribution<double> normal;
  SkinProfile profile = profile_of(skin, kVoxel_mm);
  const double kept = std::exp(-kDepthStep_mm / kNoiseLength_mm);
  double error = normal(random);
  for (double& value : profile.value) {
    error = kept * error + std::sqrt(1 - kept * kept) * normal(random);
    value += noise * error;
  }
  return profile;
}

/// Thickness as in Huang et al. (skin_slab.h), without what is thinner or thicker than is measured.
DrawnSkin drawn(double level, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  DrawnSkin skin;
  skin.thickness =
      std::clamp(usual_skin_mm * std::pow(usual_skin_factor, normal(random)), 0.5, 4.5);
  skin.surface = 0.6 * uniform(random) - 0.3;
  skin.blur = 0.45 + 0.4 * uniform(random);
  skin.level = level;
  skin.slope = usual_fat_slope * normal(random);
  return skin;
}

/// Root mean square of a way's errors, and its time.
class Way {
 public:
  template <class Fit>
  void add(double truth, const Fit& fit) {
    const std::clock_t start = std::clock();
    const double found = fit();
    seconds_ += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    squares_ += (found - truth) * (found - truth);
    ++count_;
  }
  double rms() const { return std::sqrt(squares_ / count_); }
  double milliseconds() const { return 1000 * seconds_ / count_; }

 private:
  double squares_ = 0, seconds_ = 0;
  int count_ = 0;
};

nlohmann::json row(double level, double noise) {
  std::mt19937 random(7);
  Way mean, best, probable;
  for (int n = 0; n < kSkins; ++n) {
    const DrawnSkin skin = drawn(level, random);
    const SkinProfile profile = noisy_profile(skin, noise, random);
    const auto by_ceres = [&](bool usual) {
      return skin_by_ceres(profile, kVoxel_mm, noise, usual).thickness;
    };
    mean.add(skin.thickness, [&] { return fit_skin_slab(profile, kVoxel_mm).thickness; });
    best.add(skin.thickness, [&] { return by_ceres(false); });
    probable.add(skin.thickness, [&] { return by_ceres(true); });
  }
  return {{"name", level > 1 ? "brighter than fat" : "darker than fat"},
          {"level", level},
          {"noise", noise},
          {"skins", kSkins},
          {"mean_off_mm", mean.rms()},
          {"ceres_best_off_mm", best.rms()},
          {"ceres_probable_off_mm", probable.rms()},
          {"mean_ms", mean.milliseconds()},
          {"ceres_ms", probable.milliseconds()}};
}

}  // namespace

SkinProfile profile_of(const DrawnSkin& skin, double voxel_mm) {
  SkinProfile profile;
  for (double depth = -2.875; depth < 5.5; depth += kDepthStep_mm) {
    profile.depth.push_back(depth);
    profile.value.push_back(value_at(depth, skin, voxel_mm));
  }
  return profile;
}

DrawnSkin skin_by_ceres(const SkinProfile& profile, double voxel_mm, double noise, bool usual) {
  using Cost = ceres::NumericDiffCostFunction<Left, ceres::CENTRAL, ceres::DYNAMIC, numbers>;
  DrawnSkin nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [thick, bright] : kStarts) {
    double z[numbers] = {thick, 0, 0.65, bright, 1, 0};
    const auto left = new Left{profile, voxel_mm, noise, usual};
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(left, ceres::TAKE_OWNERSHIP, left->size()), nullptr, z);
    bound(problem, z);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (summary.final_cost >= least) continue;
    least = summary.final_cost;
    nearest = skin_of(z);
  }
  return nearest;
}

nlohmann::json skin_slab_fits() {
  nlohmann::json cases = nlohmann::json::array();
  for (const double level : {2.0, 0.45})
    for (const double noise : {0.01, 0.03}) cases.push_back(row(level, noise));
  return {{"cases", cases}};
}

}  // namespace mammotwin
