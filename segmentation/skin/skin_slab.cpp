#include "segmentation/skin/skin_slab.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

constexpr double step_mm = 0.1;   // of thickness and surface, so that they share tables
constexpr int surface_steps = 8;  // to either side of the mask's surface
constexpr int thinnest_steps = static_cast<int>(thinnest_measured_skin_mm / step_mm + 0.5);
constexpr int thickest_steps = static_cast<int>(thickest_measured_skin_mm / step_mm + 0.5);
constexpr double sharpest_voxels = 0.4, softest_voxels = 0.9, blur_step_voxels = 0.05;
// A profile over a real or voxel surface is never nearer to a slab than this, over fat: its skin,
// texture and fat vary.
constexpr double least_misfit = 0.01;
constexpr double least_contrast = 0.25;  // of skin against fat at 1: less is no skin at all
// Depths of 3 mm come out this much short below skin with a radius of 40 mm.
constexpr double curvature_mm = 0.1;
constexpr double range_drop = 2;  // of the log likelihood: 95 % of a normal distribution

/// N(depth - x) for every depth of a profile, x = 0, 1, ... steps behind the first surface.
std::vector<std::vector<double>> step_table(const SkinProfile& profile, double sigma) {
  std::vector<std::vector<double>> table;
  for (int n = -surface_steps; n <= surface_steps + thickest_steps; ++n) {
    std::vector<double>& row = table.emplace_back();
    for (const double depth : profile.depth)
      row.push_back(0.5 * std::erfc((n * step_mm - depth) / (std::sqrt(2.0) * sigma)));
  }
  return table;
}

struct Candidate {
  double thickness = 0, surface = 0, skin = 0, fat = 0, squared_misfit = 0;
};

/// Skin, fat and its slope by least squares for given steps; no brightness where they make no slab.
/// `surface`, `thickness` are where the steps are.
Candidate solve_levels(const SkinProfile& profile, const std::vector<double>& outer,
                       const std::vector<double>& inner, double surface, double thickness) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  for (std::size_t r = 0; r < outer.size(); ++r) {
    const double in_fat = std::max(0.0, profile.depth[r] - surface - thickness);
    const Eigen::Vector3d basis(outer[r] - inner[r], inner[r], inner[r] * in_fat);
    normal += basis * basis.transpose();
    right += basis * profile.value[r];
    squares += profile.value[r] * profile.value[r];
  }
  // A normal distribution of slopes, against that of the misfits.
  normal(2, 2) += std::pow(least_misfit / usual_fat_slope, 2) * static_cast<double>(outer.size()) /
                  independent_profile_values;
  const Eigen::Vector3d level = normal.ldlt().solve(right);
  if (!(level.x() > 0 && level.y() > 0)) return {};
  if (std::abs(level.x() - 1) < least_contrast) return {};
  const double misfit = (squares - right.dot(level)) / static_cast<double>(outer.size());
  return {thickness, surface, level.x(), level.y(), std::max(0.0, misfit)};
}

std::vector<Candidate> all_candidates(const SkinProfile& profile, double voxel_mm) {
  std::vector<Candidate> candidates;
  const int blurs = static_cast<int>((softest_voxels - sharpest_voxels) / blur_step_voxels + 1.5);
  for (int b = 0; b < blurs; ++b) {
    const double sigma = (sharpest_voxels + b * blur_step_voxels) * voxel_mm;
    const auto table = step_table(profile, sigma);
    for (int s = 0; s <= 2 * surface_steps; ++s)
      for (int t = thinnest_steps; t <= thickest_steps; ++t) {
        const Candidate c = solve_levels(profile, table[s], table[s + t],
                                         (s - surface_steps) * step_mm, t * step_mm);
        if (c.skin > 0) candidates.push_back(c);
      }
  }
  return candidates;
}

}  // namespace

SkinSlab fit_skin_slab(const SkinProfile& profile, double voxel_mm) {
  constexpr std::size_t least_values = 12;
  if (profile.depth.size() < least_values) return {};
  const std::vector<Candidate> candidates = all_candidates(profile, voxel_mm);
  if (candidates.empty()) return {};
  const Candidate& best = *std::min_element(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.squared_misfit < b.squared_misfit; });
  const double variance =
      std::max(best.squared_misfit, least_misfit * least_misfit * best.fat * best.fat);
  SkinSlab fit;
  fit.low = fit.high = best.thickness;
  fit.misfit = std::sqrt(best.squared_misfit) / best.fat;
  double sum = 0;
  for (const Candidate& c : candidates) {
    const double drop =
        independent_profile_values / 2 * (c.squared_misfit - best.squared_misfit) / variance;
    const double usual = std::log(c.thickness / usual_skin_mm) / std::log(usual_skin_factor);
    const double weight = std::exp(-drop - usual * usual / 2);
    sum += weight;
    fit.thickness += weight * c.thickness;
    fit.surface += weight * c.surface;
    if (drop > range_drop) continue;
    fit.low = std::min(fit.low, c.thickness);
    fit.high = std::max(fit.high, c.thickness);
  }
  fit.thickness /= sum, fit.surface /= sum;
  fit.low = std::max(thinnest_measured_skin_mm, fit.low - curvature_mm);
  fit.high = std::min(thickest_measured_skin_mm, fit.high + curvature_mm);
  return fit;
}

}  // namespace mammotwin
