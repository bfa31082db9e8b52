#include "segmentation/tissue/judge_suppression.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double block_mm = 3, smoothing_mm = 6, alarm = 2;
constexpr double alarm_ml = 5;        // study: 0 to 2.4 where it worked, 66 to 126 where it failed
constexpr double layer_mm = 10;       // below the skin: fat, but for ducts at the nipple
constexpr double layer_share = 0.25;  // of bright fat; bright gland and lesions lie deeper

struct Failure {
  double ml = 0, largest_ml = 0;
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();  ///< of the largest part
};

/// One part of what is bright.
struct Part {
  double voxels = 0, in_layer = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
};

/// What is brighter than twice fat after smoothing, in parts that reach into the fat below the
/// skin.
Failure failed_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                           const Volume<float>& depth) {
  Volume<float> share;
  const Volume<float> coarse = block_means(image, interior, block_mm, share);
  const Volume<float> coarse_depth = block_means(depth, interior, block_mm, share);
  const Volume<float> smooth = weighted_smoothed(coarse, share, smoothing_mm);
  auto bright = smooth.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < smooth.values.size(); ++v)
    bright.values[v] = smooth.values[v] > alarm && share.values[v] > 0;
  const Components components = connected_components(bright);
  std::vector<Part> parts(components.sizes.size());
  for (int k = 0; k < bright.size.z(); ++k)
    for (int j = 0; j < bright.size.y(); ++j)
      for (int i = 0; i < bright.size.x(); ++i) {
        if (!bright(i, j, k)) continue;
        Part& part = parts[components.ids(i, j, k)];
        part.voxels += share(i, j, k);
        part.sum += share(i, j, k) * bright.position(i, j, k);
        if (coarse_depth(i, j, k) < layer_mm) part.in_layer += share(i, j, k);
      }
  Failure failure;
  for (const Part& part : parts) {
    if (!(part.voxels > 0) || part.in_layer < layer_share * part.voxels) continue;
    const double ml = part.voxels * smooth.voxel_volume() / 1000;
    failure.ml += ml;
    if (ml > failure.largest_ml)
      failure.largest_ml = ml, failure.middle_in_lps = part.sum / part.voxels;
  }
  return failure;
}

/// Radius of a ball [mm].
double ball_radius(double ml) { return std::cbrt(750 * ml / std::numbers::pi); }

}  // namespace

void judge_suppression(const Volume<float>& image, const Volume<std::uint8_t>& interior,
                       const Volume<float>& depth, double sternal_y, SegmentQuality& quality) {
  auto hanging = interior;
  for (int k = 0; k < hanging.size.z(); ++k)
    for (int j = 0; j < hanging.size.y(); ++j)
      for (int i = 0; i < hanging.size.x(); ++i)
        hanging(i, j, k) &= hanging.position(i, j, k).y() < sternal_y;
  const Failure failure = failed_suppression(image, hanging, depth);
  quality.failed_suppression_ml = failure.ml;
  if (failure.ml <= alarm_ml) return;
  std::ostringstream reason;
  reason.setf(std::ios::fixed);
  reason.precision(0);
  reason << "fat suppression seems to have failed in " << failure.ml
         << " ml of the breast: bright fat there passes for fibroglandular tissue";
  quality.doubt(SegmentStatus::look, {"fat suppression", reason.str(), failure.middle_in_lps,
                                      ball_radius(failure.largest_ml)});
}

}  // namespace mammotwin
