#include "segmentation/body/body_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/order_statistics.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

float quantile_or_zero(std::vector<float>& values, double share) {
  return values.empty() ? 0 : quantile(values, share);
}

/// Sets to body what neither the front nor the sides of a slice reach through air.
void fill_slice(Volume<std::uint8_t>& body, int k) {
  const int nx = body.size.x(), ny = body.size.y();
  std::vector<std::uint8_t> air(static_cast<std::size_t>(nx) * ny, 0);
  std::vector<std::pair<int, int>> stack;
  const auto visit = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= nx || j >= ny || body(i, j, k)) return;
    std::uint8_t& seen = air[static_cast<std::size_t>(j) * nx + i];
    if (!seen) seen = 1, stack.emplace_back(i, j);
  };
  for (int i = 0; i < nx; ++i) visit(i, 0);
  for (int j = 0; j < ny; ++j) visit(0, j), visit(nx - 1, j);
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    visit(i - 1, j), visit(i + 1, j), visit(i, j - 1), visit(i, j + 1);
  }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) body(i, j, k) = !air[static_cast<std::size_t>(j) * nx + i];
}

double mean_spacing(const Eigen::Vector3d& spacing) { return std::cbrt(spacing.prod()); }

/// Where the body begins in a slice. Where noise is low (interpolated images, strong coils) what
/// passes 6 times it is in good part haze in the air, which pulls tissue's median down; it stays
/// below a share of what is brightest.
double body_threshold(const float* first, std::size_t voxels, double noise) {
  constexpr double noise_factor = 6, tissue_share = 0.25;
  constexpr double bright_quantile = 0.95, haze_share = 0.05;
  std::vector<float> tissue;
  for (std::size_t v = 0; v < voxels; ++v)
    if (first[v] > noise_factor * noise) tissue.push_back(first[v]);
  return std::max({noise_factor * noise, tissue_share * quantile_or_zero(tissue, 0.5),
                   haze_share * quantile_or_zero(tissue, bright_quantile)});
}

}  // namespace

double estimate_noise(const Volume<float>& image) {
  std::vector<float> sample;  // every seventh voxel is plenty
  for (std::size_t v = 0; v < image.values.size(); v += 7)
    if (image.values[v] > 0) sample.push_back(image.values[v]);
  // A Rayleigh distribution has 10 % below 0.459 sigma; cut at 3 sigma, its mean square is 1.899
  // sigma^2. The fixed point belongs to air as long as air is a tenth of the image.
  double sigma = quantile_or_zero(sample, 0.10) / 0.459;
  for (int round = 0; round < 20; ++round) {
    double sum = 0, count = 0;
    for (const float value : sample)
      if (value < 3 * sigma) sum += static_cast<double>(value) * value, ++count;
    if (count > 0) sigma = std::sqrt(sum / count / 1.899);
  }
  const float middle = quantile_or_zero(sample, 0.5);
  std::vector<float> upper;
  for (const float value : sample)
    if (value > middle) upper.push_back(value);
  return std::min(sigma, 0.1 * quantile_or_zero(upper, 0.5));
}

Volume<std::uint8_t> coarse_body(const Volume<float>& image, double noise) {
  constexpr double opening_voxels = 2;
  auto body = image.like<std::uint8_t>(0);
  const std::size_t slice = static_cast<std::size_t>(image.size.x()) * image.size.y();
  tbb::parallel_for(0, image.size.z(), [&](int k) {
    const float* first = image.values.data() + k * slice;
    const double threshold = body_threshold(first, slice, noise);
    for (std::size_t v = 0; v < slice; ++v) body.values[k * slice + v] = first[v] > threshold;
  });
  // Filled first, so that dark tissue inside does not open.
  tbb::parallel_for(0, image.size.z(), [&](int k) { fill_slice(body, k); });
  body = largest_component(opened(body, opening_voxels * mean_spacing(image.spacing)));
  tbb::parallel_for(0, image.size.z(), [&](int k) { fill_slice(body, k); });
  return body;
}

Volume<float> depth_below_surface(const Volume<std::uint8_t>& mask) {
  auto outside = mask;
  for (std::uint8_t& value : outside.values) value = !value;
  Volume<float> depth = distance_to(outside);
  const auto half = static_cast<float>(mean_spacing(mask.spacing) / 2);
  for (std::size_t v = 0; v < depth.values.size(); ++v)
    depth.values[v] = mask.values[v] ? std::max(0.1F * half, depth.values[v] - half) : 0;
  return depth;
}

namespace {

bool touches_outside(const Volume<std::uint8_t>& body, int i, int j, int k) {
  const auto out = [&](int a, int b, int c) { return body.contains(a, b, c) && !body(a, b, c); };
  return out(i - 1, j, k) || out(i + 1, j, k) || out(i, j - 1, k) || out(i, j + 1, k) ||
         out(i, j, k - 1) || out(i, j, k + 1);
}

/// One layer of voxels that face air and are marked.
void peel(const Volume<std::uint8_t>& marked, Volume<std::uint8_t>& body) {
  const Volume<std::uint8_t> before = body;
  tbb::parallel_for(0, body.size.z(), [&](int k) {
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i)
        if (before(i, j, k) && marked(i, j, k) && touches_outside(before, i, j, k))
          body(i, j, k) = 0;
  });
}

}  // namespace

Volume<std::uint8_t> cut_ghosts(const Volume<float>& image, const Volume<std::uint8_t>& body,
                                double share) {
  constexpr int deepest_layers = 12;
  constexpr double near_voxels = 1.5, around_mm = 8;
  auto weight = image.like<float>(0);
  for (std::size_t v = 0; v < body.values.size(); ++v) weight.values[v] = body.values[v];
  const Volume<float> here =
      weighted_smoothed(image, weight, near_voxels * mean_spacing(image.spacing));
  const Volume<float> around = weighted_smoothed(image, weight, around_mm);
  auto dim = body;
  for (std::size_t v = 0; v < dim.values.size(); ++v)
    dim.values[v] = here.values[v] < share * around.values[v];
  auto out = body;
  for (int layer = 0; layer < deepest_layers; ++layer) peel(dim, out);
  return largest_component(out);
}

Volume<std::uint8_t> cut_islands(const Volume<std::uint8_t>& body) {
  constexpr double neck_mm = 4;  // half of its thickness
  constexpr float near_mm = 3, far_mm = 15;
  const Volume<std::uint8_t> core = largest_component(opened(body, neck_mm));
  const Volume<float> away = distance_to(core);
  Volume<std::uint8_t> apart = body;
  for (std::size_t v = 0; v < apart.values.size(); ++v) apart.values[v] &= away.values[v] > near_mm;
  const Components parts = connected_components(apart);
  std::vector<float> reach(parts.sizes.size(), 0);
  for (std::size_t v = 0; v < apart.values.size(); ++v)
    if (apart.values[v])
      reach[parts.ids.values[v]] = std::max(reach[parts.ids.values[v]], away.values[v]);
  for (std::size_t v = 0; v < apart.values.size(); ++v)
    apart.values[v] = reach[parts.ids.values[v]] > far_mm;
  const Volume<std::uint8_t> islands = dilated(apart, neck_mm);
  Volume<std::uint8_t> out = body;
  for (std::size_t v = 0; v < out.values.size(); ++v)
    out.values[v] &= core.values[v] || !islands.values[v];
  return out;
}

Volume<std::uint8_t> cut_rim(const Volume<float>& image, const Volume<std::uint8_t>& body,
                             double share) {
  constexpr int rim_voxels = 4;
  constexpr double pit_voxels = 2;
  const Volume<float> brightest = local_maximum(image, 2);
  auto out = body;
  auto dark = body;
  for (std::size_t v = 0; v < dark.values.size(); ++v)
    dark.values[v] = image.values[v] < share * brightest.values[v];
  for (int layer = 0; layer < rim_voxels; ++layer) peel(dark, out);
  out = closed(out, pit_voxels * mean_spacing(image.spacing));  // where thin skin let it through
  for (std::size_t v = 0; v < out.values.size(); ++v) out.values[v] &= body.values[v];
  tbb::parallel_for(0, image.size.z(), [&](int k) { fill_slice(out, k); });
  return largest_component(out);
}

namespace {

/// Share of a Gaussian around each voxel of a line that lies on the line.
std::vector<float> share_on_line(int n, double sigma_voxels) {
  const auto below = [&](double x) {
    return 0.5 * std::erfc(-x / (std::sqrt(2.0) * sigma_voxels));
  };
  std::vector<float> share;
  for (int q = 0; q < n; ++q)
    share.push_back(static_cast<float>(below(q + 0.5) + below(n - q - 0.5) - 1));
  return share;
}

}  // namespace

Volume<float> signed_depth(Volume<float> share, double reach) {
  constexpr double step_mm = 0.05, sharp_reach_mm = 4.4;  // the Gaussian is cut at 3 widths
  const double sigma = reach / (reach > sharp_reach_mm ? 2.2 : 2.75);
  std::vector<float> normal;  // inside, at depth -reach, -reach + step, ...
  for (double d = -reach; d <= reach; d += step_mm)
    normal.push_back(static_cast<float>(0.5 * std::erfc(-d / (std::sqrt(2.0) * sigma))));
  Volume<float> depth = gaussian_smoothed(std::move(share), sigma);
  std::vector<float> on[3];
  for (int a = 0; a < 3; ++a) on[a] = share_on_line(depth.size[a], sigma / depth.spacing[a]);
  tbb::parallel_for(0, depth.size.z(), [&](int k) {
    for (int j = 0; j < depth.size.y(); ++j)
      for (int i = 0; i < depth.size.x(); ++i) {
        const float value = depth(i, j, k) / (on[0][i] * on[1][j] * on[2][k]);
        const auto n = std::lower_bound(normal.begin(), normal.end(), value) - normal.begin();
        depth(i, j, k) =
            static_cast<float>(std::min(reach, -reach + static_cast<double>(n) * step_mm));
      }
  });
  return depth;
}

}  // namespace mammotwin
