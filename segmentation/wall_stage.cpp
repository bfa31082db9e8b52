#include "segmentation/wall_stage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "segmentation/em_bias.h"
#include "segmentation/smoothing.h"

namespace mammotwin {
namespace {

constexpr int num_classes = 4;  // lung and noise, fat, muscle and gland, vessels and skin

/// Muscle over fat: the class nearest to what the study saw (1.4 to 2.0, 0.4), if in range.
double muscle_over_fat(const BiasEstimate& bias, double log_fat, bool fat_suppressed) {
  const double usual = fat_suppressed ? 1.55 : 0.40;
  const double low = fat_suppressed ? 1.25 : 0.25, high = fat_suppressed ? 2.0 : 0.65;
  double best = usual, nearest = 1e9;
  for (const IntensityClass& c : bias.classes) {
    const double ratio = std::exp(c.mean - log_fat);
    if (ratio < low || ratio > high || std::abs(std::log(ratio / usual)) > nearest) continue;
    nearest = std::abs(std::log(ratio / usual));
    best = ratio;
  }
  return best;
}

/// The body with its thorax closed: where a flank is too dim to be seen, the lung passes for air,
/// and rays would end in it. From 20 mm behind the skin between the breasts on, a row is body
/// between the outermost body voxels of itself and the rows in front of it.
Volume<std::uint8_t> with_closed_thorax(const BodyStage& stage) {
  constexpr double behind_mm = 20;
  Volume<std::uint8_t> body = stage.body;
  const int first = static_cast<int>(
      std::ceil((stage.frame.sternal_y + behind_mm - body.origin.y()) / body.spacing.y()));
  for (int k = 0; k < body.size.z(); ++k) {
    int low = body.size.x(), high = -1;
    for (int j = std::max(0, first); j < body.size.y(); ++j) {
      for (int i = 0; i < body.size.x(); ++i)
        if (body(i, j, k)) low = std::min(low, i), high = std::max(high, i);
      for (int i = low; i <= high; ++i) body(i, j, k) = 1;
    }
  }
  return body;
}

}  // namespace

WallStage find_wall(const BodyStage& body, double stiffness) {
  const BiasEstimate bias = estimate_bias(body.image, body.body, num_classes);
  WallStage stage;
  stage.wide_log_bias = bias.wide_log_bias;
  stage.corrected = body.image;
  Volume<float>& corrected = stage.corrected;
  tbb::parallel_for(0, corrected.size.z(), [&](int k) {
    for (int j = 0; j < corrected.size.y(); ++j)
      for (int i = 0; i < corrected.size.x(); ++i)
        corrected(i, j, k) *= bias.correction(corrected.position(i, j, k));
  });
  const double fat =
      subcutaneous_fat(corrected, body.depth, body.frame, body.contrast.fat_suppressed);
  for (float& value : corrected.values) value /= static_cast<float>(fat);
  stage.contrast.muscle = muscle_over_fat(bias, std::log(fat), body.contrast.fat_suppressed);
  constexpr double ray_smoothing_mm = 0.8;  // about a voxel: noise falls, the edge stays
  stage.wall = find_pectoral_wall(gaussian_smoothed(corrected, ray_smoothing_mm),
                                  with_closed_thorax(body), body.frame, stage.contrast, stiffness);
  return stage;
}

}  // namespace mammotwin
