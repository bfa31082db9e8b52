#include "segmentation/skin.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/body_mask.h"

namespace mammotwin {
namespace {

constexpr double bin_mm = 0.25, outermost_mm = -3, innermost_mm = 5.5;
constexpr double thinnest_mm = 0.5, thickness_step_mm = 0.05;
constexpr std::size_t least_in_bin = 50;

/// Median brightness by signed depth below the surface of the mask (negative: in air).
struct Profile {
  std::vector<double> depth, value;
};

Profile median_profile(const Volume<float>& image, const Volume<std::uint8_t>& body,
                       const Volume<std::uint8_t>& where) {
  const Volume<float> depth_of = signed_depth(body, innermost_mm);
  const int bins = static_cast<int>((innermost_mm - outermost_mm) / bin_mm);
  std::vector<std::vector<float>> samples(bins);
  for (std::size_t v = 0; v < image.values.size(); ++v) {
    if (!where.values[v]) continue;
    const double depth = depth_of.values[v];
    const int bin = static_cast<int>(std::floor((depth - outermost_mm) / bin_mm));
    if (bin >= 0 && bin < bins) samples[bin].push_back(image.values[v]);
  }
  Profile profile;
  for (int b = 0; b < bins; ++b) {
    if (samples[b].size() < least_in_bin) continue;
    std::nth_element(samples[b].begin(), samples[b].begin() + samples[b].size() / 2,
                     samples[b].end());
    profile.depth.push_back(outermost_mm + (b + 0.5) * bin_mm);
    profile.value.push_back(samples[b][samples[b].size() / 2]);
  }
  return profile;
}

/// Share of a Gaussian that lies beyond a step.
double step(double x, double sigma) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * sigma)); }

struct SlabFit {
  double thickness = 0;
  double misfit = 1e30;  ///< root mean square
  double fat = 1;
};

/// Best slab for one blur: thickness and place of the surface by search, the three levels of
/// brightness by least squares.
SlabFit fit_slab(const Profile& profile, double sigma) {
  const auto n = static_cast<Eigen::Index>(profile.depth.size());
  const Eigen::Map<const Eigen::VectorXd> y(profile.value.data(), n);
  SlabFit best;
  for (double surface = -1.5; surface <= 1.5; surface += 0.1)
    for (double t = thinnest_mm; t <= thickest_measured_skin_mm; t += thickness_step_mm) {
      Eigen::MatrixXd basis(n, 3);  // air, skin, fat
      for (Eigen::Index r = 0; r < n; ++r) {
        const double outer = step(profile.depth[r] - surface, sigma);
        const double inner = step(profile.depth[r] - surface - t, sigma);
        basis.row(r) << 1 - outer, outer - inner, inner;
      }
      const Eigen::Vector3d level = (basis.transpose() * basis).ldlt().solve(basis.transpose() * y);
      if (!(level.y() > 0)) continue;
      const double misfit = std::sqrt((basis * level - y).squaredNorm() / static_cast<double>(n));
      if (misfit < best.misfit) best = {t, misfit, level.z()};
    }
  return best;
}

}  // namespace

SkinThickness measure_skin(const Volume<float>& image, const Volume<std::uint8_t>& body,
                           const Volume<std::uint8_t>& where) {
  constexpr double blur_voxels = 0.55, more = 1.3, less = 0.75;
  const Profile profile = median_profile(image, body, where);
  constexpr std::size_t least_bins = 12;
  if (profile.depth.size() < least_bins) return {};
  const double sigma = blur_voxels * std::cbrt(image.voxel_volume());
  const SlabFit fit = fit_slab(profile, sigma);
  SkinThickness skin;
  skin.thickness = fit.thickness;
  skin.misfit = fit.misfit / std::max(1e-6, fit.fat);
  const double a = fit_slab(profile, more * sigma).thickness;
  const double b = fit_slab(profile, less * sigma).thickness;
  skin.low = std::min({a, b, fit.thickness});
  skin.high = std::max({a, b, fit.thickness});
  return skin;
}

}  // namespace mammotwin
