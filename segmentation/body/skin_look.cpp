#include "segmentation/body/skin_look.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/order_statistics.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Mask = Volume<std::uint8_t>;

constexpr double fine_mm = 5.5, coarse_mm = 13.2;  // reach of a depth smoothed over 2.5 and 6 mm
constexpr double around_mm = 12;                   // what brightness is compared with
constexpr double over_skin_mm = 2;                 // a mean over about 4 mm
constexpr double least_forward = 0.05;             // of the inward normal
constexpr double most_standing_mm = 8;             // more is a fold or an edge
constexpr int shallow_from_mm = 1, shallow_to_mm = 5, deep_from_mm = 6, deep_to_mm = 12;
constexpr double least_spread_mm = 0.15, least_spread = 0.03;

struct Measures {
  Volume<float> stands_out, bright, bright_deep;  ///< at the skin's voxels; 0 elsewhere
  Volume<float> is_skin;
};

bool faces_air(const Mask& body, const Vector3i& v) {
  for (int axis = 0; axis < 3; ++axis)
    for (const int step : {-1, 1}) {
      Vector3i n = v;
      n[axis] += step;
      if (body.contains(n.x(), n.y(), n.z()) && !body(n.x(), n.y(), n.z())) return true;
    }
  return false;
}

Vector3d gradient(const Volume<float>& depth, const Vector3i& v) {
  Vector3d g;
  for (int axis = 0; axis < 3; ++axis) {
    Vector3i low = v, high = v;
    low[axis] = std::max(0, v[axis] - 1);
    high[axis] = std::min(depth.size[axis] - 1, v[axis] + 1);
    g[axis] = (depth(high.x(), high.y(), high.z()) - depth(low.x(), low.y(), low.z())) /
              ((high[axis] - low[axis]) * depth.spacing[axis]);
  }
  return g;
}

double mean_below(const Volume<float>& look, const Vector3d& x, const Vector3d& inward, int from,
                  int to) {
  double sum = 0;
  for (int d = from; d <= to; ++d) sum += interpolated(look, x + d * inward);
  return sum / (to - from + 1);
}

Measures measure(const Mask& body, const Volume<float>& look, const Vector3d& middle,
                 double reach_mm) {
  auto share = body.like<float>(0);
  std::copy(body.values.begin(), body.values.end(), share.values.begin());
  const Volume<float> around = weighted_smoothed(look, share, around_mm);
  const Volume<float> fine = signed_depth(share, fine_mm), coarse = signed_depth(share, coarse_mm);
  const auto empty = body.like<float>(0);
  Measures found{empty, empty, empty, empty};
  tbb::parallel_for(0, body.size.z(), [&](int k) {
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        const Vector3d x = body.position(i, j, k);
        if (!body(i, j, k) || (x - middle).norm() > reach_mm || !faces_air(body, {i, j, k}))
          continue;
        const Vector3d inward = gradient(coarse, {i, j, k}).stableNormalized();
        if (!(inward.y() > least_forward)) continue;
        const double mean = interpolated(around, x + deep_from_mm * inward);
        if (!(mean > 0)) continue;
        found.is_skin(i, j, k) = 1;
        found.stands_out(i, j, k) =
            static_cast<float>(std::min<double>(fine(i, j, k) - coarse(i, j, k), most_standing_mm));
        found.bright(i, j, k) =
            static_cast<float>(mean_below(look, x, inward, shallow_from_mm, shallow_to_mm) / mean);
        found.bright_deep(i, j, k) =
            static_cast<float>(mean_below(look, x, inward, deep_from_mm, deep_to_mm) / mean);
      }
  });
  return found;
}

/// In spreads from the median.
std::vector<double> standardised(const std::vector<double>& values, double least) {
  constexpr double low = 0.16, high = 0.84, lowest = -3, highest = 6;
  std::vector<double> sorted = values;
  const double spread = std::max(least, (quantile(sorted, high) - quantile(sorted, low)) / 2);
  const double middle = median(sorted);
  std::vector<double> out;
  for (const double value : values)
    out.push_back(std::clamp((value - middle) / spread, lowest, highest));
  return out;
}

}  // namespace

std::vector<SkinPoint> skin_around(const Mask& body, const Volume<float>& look,
                                   const Vector3d& middle, double reach_mm) {
  const Measures at = measure(body, look, middle, reach_mm);
  std::vector<SkinPoint> points;
  const auto smoothed = [&](const Volume<float>& values, double least) {
    const Volume<float> mean = weighted_smoothed(values, at.is_skin, over_skin_mm);
    std::vector<double> on_skin;
    for (std::size_t v = 0; v < mean.values.size(); ++v)
      if (at.is_skin.values[v] > 0) on_skin.push_back(mean.values[v]);
    return on_skin.empty() ? on_skin : standardised(on_skin, least);
  };
  const std::vector<double> stands_out = smoothed(at.stands_out, least_spread_mm),
                            bright = smoothed(at.bright, least_spread),
                            bright_deep = smoothed(at.bright_deep, least_spread);
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        if (!(at.is_skin(i, j, k) > 0)) continue;
        const std::size_t n = points.size();
        points.push_back({body.position(i, j, k), stands_out[n], bright[n], bright_deep[n]});
      }
  return points;
}

}  // namespace mammotwin
