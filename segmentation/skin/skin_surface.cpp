#include "segmentation/skin/skin_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/skin/skin.h"

namespace mammotwin {
namespace {

constexpr int rounds = 3;
constexpr double alignment_reach_mm = 4.4;  // 2.75 widths of 1.6 mm: little is rounded off
constexpr double depth_reach_mm = 5.5;
constexpr double band_outside_mm = 2.5, band_inside_mm = 1.2;  // the skin's outer edge
constexpr double shift_over_mm = 1.5, gain_over_mm = 12, block_mm = 2.4;
constexpr double largest_shift_mm = 1;

/// A profile to be read at any depth, with its slope.
class Template {
 public:
  explicit Template(SkinProfile profile) : depth_(profile.depth), value_(profile.value) {
    for (int pass = 0; pass < 2; ++pass) {
      const std::vector<double> before = value_;
      for (std::size_t n = 1; n + 1 < value_.size(); ++n)
        value_[n] = (before[n - 1] + 2 * before[n] + before[n + 1]) / 4;
    }
  }

  struct Value {
    float value, slope;
  };
  Value at(double depth) const {
    const auto next = std::upper_bound(depth_.begin() + 1, depth_.end() - 1, depth);
    const auto n = next - depth_.begin();
    const double slope = (value_[n] - value_[n - 1]) / (depth_[n] - depth_[n - 1]);
    const double value = value_[n - 1] + slope * (depth - depth_[n - 1]);
    return {static_cast<float>(std::max(0.0, value)), static_cast<float>(slope)};
  }

 private:
  std::vector<double> depth_, value_;
};

/// Sums of the least-squares problem in blocks of voxels: P P, P P', P' P', I P, I P'.
using Moments = std::array<Volume<float>, 5>;

/// The gain over a wide neighbourhood (where skin is dark and thin, it looks like a shift), and the
/// sums for the shift over a narrow one.
struct Alignment {
  Moments wide, narrow;
};

Alignment align_blocks(const Volume<float>& image, const Volume<float>& depth,
                       const Template& profile) {
  const Eigen::Vector3i f = (block_mm / image.spacing.array()).round().max(1).cast<int>().matrix();
  const Eigen::Vector3i size = ((image.size.array() + f.array() - 1) / f.array()).matrix();
  const Eigen::Vector3d middle =
      image.origin + ((f.cast<double>().array() - 1) / 2 * image.spacing.array()).matrix();
  Moments sums;
  sums.fill(Volume<float>(size, image.spacing.cwiseProduct(f.cast<double>()), middle, 0));
  tbb::parallel_for(0, size.z(), [&](int c) {
    for (int k = c * f.z(); k < std::min(image.size.z(), (c + 1) * f.z()); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i) {
          const float d = depth(i, j, k);
          if (!(d > -band_outside_mm && d < band_inside_mm)) continue;
          const auto [p, slope] = profile.at(d);
          const float value = image(i, j, k);
          const std::size_t block = sums[0].offset(i / f.x(), j / f.y(), c);
          sums[0].values[block] += p * p;
          sums[1].values[block] += p * slope;
          sums[2].values[block] += slope * slope;
          sums[3].values[block] += value * p;
          sums[4].values[block] += value * slope;
        }
  });
  Alignment alignment{sums, sums};
  for (Volume<float>& sum : alignment.wide) sum = gaussian_smoothed(std::move(sum), gain_over_mm);
  for (Volume<float>& sum : alignment.narrow)
    sum = gaussian_smoothed(std::move(sum), shift_over_mm);
  return alignment;
}

/// By how much deeper than `depth` says the profile shows around a point.
double shift_at(const Alignment& alignment, const Eigen::Vector3d& x) {
  const auto at = [&](const Moments& moments) {
    std::array<double, 5> m;
    for (std::size_t n = 0; n < m.size(); ++n) m[n] = interpolated(moments[n], x);
    return m;
  };
  const auto [pp, ps, ss, ip, is] = at(alignment.wide);
  const double det = pp * ss - ps * ps;
  if (!(det > 1e-3 * pp * ss)) return 0;
  const double gain = (ip * ss - is * ps) / det;
  const auto here = at(alignment.narrow);
  if (!(gain > 0 && here[2] > 0)) return 0;
  return std::clamp((here[4] / gain - here[1]) / here[2], -largest_shift_mm, largest_shift_mm);
}

/// Share of each voxel that is body, after the surface has been shifted to `zero` of the profile
/// and to where the image shows it.
Volume<float> shifted_share(const Volume<float>& depth, double zero, const Alignment& alignment) {
  constexpr double reach_mm = 2.4;  // no shift takes the surface farther
  const double voxel = std::cbrt(depth.voxel_volume());
  auto share = depth.like<float>(0);
  tbb::parallel_for(0, depth.size.z(), [&](int k) {
    for (int j = 0; j < depth.size.y(); ++j)
      for (int i = 0; i < depth.size.x(); ++i) {
        double d = depth(i, j, k);
        if (std::abs(d) < reach_mm) d += shift_at(alignment, depth.position(i, j, k)) - zero;
        share(i, j, k) = static_cast<float>(std::clamp(0.5 + d / voxel, 0.0, 1.0));
      }
  });
  return share;
}

}  // namespace

SkinSurface find_skin_surface(const Volume<float>& image, const Volume<std::uint8_t>& body,
                              const Volume<std::uint8_t>& where) {
  auto share = body.like<float>(0);
  std::copy(body.values.begin(), body.values.end(), share.values.begin());
  for (int round = 0; round < rounds; ++round) {
    const Volume<float> depth = signed_depth(share, alignment_reach_mm);
    const SkinProfile profile = skin_profile(image, depth, where, alignment_reach_mm);
    const SkinSlab slab = fit_skin_slab(without_noise(profile), std::cbrt(image.voxel_volume()));
    if (!(slab.thickness > 0)) break;
    share = shifted_share(depth, slab.surface, align_blocks(image, depth, Template(profile)));
  }
  SkinSurface surface{body, signed_depth(share, depth_reach_mm)};
  for (std::size_t v = 0; v < body.values.size(); ++v)
    surface.body.values[v] = share.values[v] > 0.5F;
  return surface;
}

}  // namespace mammotwin
