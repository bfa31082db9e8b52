#include "segmentation/body/half_breast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/order_statistics.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/shading/flank_shading.h"
#include "segmentation/shading/n4.h"
#include "segmentation/skin/skin_stage.h"

namespace mammotwin {
namespace {

constexpr double kept_behind_sternum_mm = 100;
constexpr double skin_mm = 4, wall_mm = 2;  // left out of the bias: study, section 4
constexpr double n4_block_mm = 4;

struct Crop {
  Eigen::Vector3i low, high;
};

Crop side_box(const Volume<float>& image, const BreastFrame& frame, Side side) {
  const auto column = [&](double x) {
    return std::clamp(static_cast<int>(std::ceil((x - image.origin.x()) / image.spacing.x())), 0,
                      image.size.x() - 1);
  };
  const int middle = column(frame.midline_x);
  const int rear =
      std::clamp(static_cast<int>((frame.sternal_y + kept_behind_sternum_mm - image.origin.y()) /
                                  image.spacing.y()),
                 0, image.size.y() - 1);
  Crop crop{Eigen::Vector3i::Zero(), {image.size.x() - 1, rear, image.size.z() - 1}};
  (side == Side::left ? crop.low.x() : crop.high.x()) = middle;
  return crop;
}

/// The logarithm of the bias that N4 finds in `where`, 0 in the mean there, on blocks of 4 mm.
std::optional<Volume<float>> bias_by_n4(const Volume<float>& image,
                                        const Volume<std::uint8_t>& where) {
  Volume<float> share;
  const Volume<float> coarse = block_means(image, where, n4_block_mm, share);
  RawImage raw;
  std::vector<std::uint8_t> mask;
  for (int a = 0; a < 3; ++a) {
    raw.size[a] = coarse.size[a];
    raw.spacing[a] = coarse.spacing[a];
  }
  std::size_t in = 0;
  for (std::size_t v = 0; v < coarse.values.size(); ++v) {
    raw.values.push_back(std::max(coarse.values[v], 1e-3F));
    mask.push_back(share.values[v] > 0.5F);
    in += mask.back();
  }
  constexpr std::size_t least_blocks = 200;
  if (in < least_blocks) return std::nullopt;
  Volume<float> field = coarse.like<float>(0);
  field.values = n4_log_bias(raw, mask);
  double mean = 0;
  for (std::size_t v = 0; v < mask.size(); ++v)
    if (mask[v]) mean += field.values[v];
  mean /= static_cast<double>(in);
  // Beyond the blocks that N4 saw the field is the nearest one's, smoothly.
  Volume<float> weight = coarse.like<float>(0);
  for (std::size_t v = 0; v < mask.size(); ++v) weight.values[v] = mask[v];
  const Volume<float> spread = weighted_smoothed(field, weight, 12);
  for (std::size_t v = 0; v < mask.size(); ++v) {
    if (!mask[v]) field.values[v] = spread.values[v] != 0 ? spread.values[v] : mean;
    field.values[v] -= static_cast<float>(mean);
  }
  return field;
}

/// The breast away from skin and wall.
Volume<std::uint8_t> pure_interior(const HalfBreast& half) {
  auto where = half.inside;
  for (std::size_t v = 0; v < where.values.size(); ++v)
    where.values[v] &= half.depth.values[v] > skin_mm && half.above_wall.values[v] > wall_mm;
  return where;
}

/// The image with 60 mm of bias taken out and the median of what lies in `where` at 1.
Volume<float> corrected_widely(Volume<float> image, const Volume<float>& log_bias,
                               const Volume<std::uint8_t>& where) {
  std::vector<float> values;
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        image(i, j, k) *= std::exp(-interpolated(log_bias, image.position(i, j, k)));
        if (where(i, j, k)) values.push_back(image(i, j, k));
      }
  if (values.empty()) return image;
  const float one = std::max(median(values), 1e-6F);
  for (float& value : image.values) value /= one;
  return image;
}

/// Fills the images of one side. The wall was found in the scan as it is, where the filter blurs
/// the faint edge of muscle far from the coil.
void cut_images(const BodyStage& body, const WallStage& wall, const Crop& crop, HalfBreast& half) {
  half.scan = cropped(wall.corrected, crop.low, crop.high);
  half.image = half.scan;
  half.noise = half.scan.like<float>(0);
  if (body.noise > 0) half.noise_spread = body.noise_at_distance / body.noise;
  const Volume<float> scan = cropped(body.image, crop.low, crop.high);
  const Volume<float> clean = cropped(body.clean, crop.low, crop.high);
  if (!body.pre.values.empty()) half.pre = cropped(body.pre, crop.low, crop.high);
  half.pre_match = wall.pre_match;
  for (std::size_t v = 0; v < scan.values.size(); ++v) {
    if (!(scan.values[v] > 0)) continue;
    const float gain = half.scan.values[v] / scan.values[v];
    if (!half.pre.values.empty()) half.pre.values[v] *= gain;
    half.image.values[v] = clean.values[v] * gain;
    half.noise.values[v] = static_cast<float>(body.noise) * gain;
  }
}

}  // namespace

HalfBreast cut_half(const BodyStage& body, const WallStage& wall, Side side) {
  const Crop crop = side_box(body.image, body.frame, side);
  HalfBreast half;
  half.side = side;
  cut_images(body, wall, crop, half);
  if (!body.enhancement.values.empty())
    half.enhancement = cropped(body.enhancement, crop.low, crop.high);
  SkinStage skin = find_skin(half.scan, cropped(body.body, crop.low, crop.high), body.frame);
  half.body = std::move(skin.surface.body);
  half.depth = depth_below_surface(half.body);
  half.skin_depth = std::move(skin.surface.depth);
  half.skin = skin.slab;
  half.inside = half.body;
  auto behind = half.body.like<std::uint8_t>(0);
  tbb::parallel_for(0, half.body.size.z(), [&](int k) {
    for (int j = 0; j < half.body.size.y(); ++j)
      for (int i = 0; i < half.body.size.x(); ++i) {
        if (!half.body(i, j, k)) continue;
        behind(i, j, k) = wall.wall.is_behind(half.body.position(i, j, k));
        half.inside(i, j, k) = !behind(i, j, k);
      }
  });
  half.above_wall = distance_to(behind);
  half.widely_corrected = corrected_widely(cropped(body.image, crop.low, crop.high),
                                           wall.wide_log_bias, pure_interior(half));
  return half;
}

void correct_shading(const BreastFrame& frame, HalfBreast& half) {
  std::vector<Volume<float>*> images = {&half.image, &half.scan, &half.noise};
  if (!half.pre.values.empty()) images.push_back(&half.pre);
  const Volume<float> flank = flank_shading(half.image, half.depth, frame);
  for (std::size_t v = 0; v < flank.values.size(); ++v)
    for (Volume<float>* image : images) image->values[v] /= flank.values[v];
  const auto field = bias_by_n4(half.image, pure_interior(half));
  if (!field) return;
  tbb::parallel_for(0, half.image.size.z(), [&](int k) {
    for (int j = 0; j < half.image.size.y(); ++j)
      for (int i = 0; i < half.image.size.x(); ++i) {
        const float gain = std::exp(-interpolated(*field, half.image.position(i, j, k)));
        for (Volume<float>* image : images) (*image)(i, j, k) *= gain;
      }
  });
}

}  // namespace mammotwin
