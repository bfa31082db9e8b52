#include "segmentation/shading/correct_shading.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "segmentation/image/masked.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/shading/flank_shading.h"
#include "segmentation/shading/n4.h"

namespace mammotwin {
namespace {

constexpr double n4_block_mm = 4;

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

/// Those of the images that have the bias.
std::vector<Volume<float>*> biased(HalfImages& images) {
  std::vector<Volume<float>*> all = {&images.denoised, &images.noisy, &images.noise};
  if (!images.pre.values.empty()) all.push_back(&images.pre);
  return all;
}

HalfImages divided(HalfImages images, const Volume<float>& shading) {
  for (Volume<float>* image : biased(images))
    for (std::size_t v = 0; v < shading.values.size(); ++v) image->values[v] /= shading.values[v];
  return images;
}

/// Every image times `gain(i, j, k)`.
template <class Gain>
HalfImages times(HalfImages images, const Gain& gain) {
  const std::vector<Volume<float>*> all = biased(images);
  const Eigen::Vector3i size = images.noisy.size;
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) {
        const float factor = gain(i, j, k);
        for (Volume<float>* image : all) (*image)(i, j, k) *= factor;
      }
  });
  return images;
}

}  // namespace

HalfImages correct_shading(const HalfImages& images, const HalfBreast& half,
                           const BreastFrame& frame) {
  const Volume<float> flank = flank_shading(images.denoised, half.depth, frame);
  HalfImages even = divided(images, flank);
  const auto log_bias = bias_by_n4(even.denoised, pure_interior(half));
  if (!log_bias) return even;
  return times(std::move(even), [&](int i, int j, int k) {
    return std::exp(-interpolated(*log_bias, half.body.position(i, j, k)));
  });
}

Volume<float> widely_corrected(Volume<float> image, const Volume<float>& wide_log_bias,
                               const Volume<std::uint8_t>& where) {
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        image(i, j, k) *= std::exp(-interpolated(wide_log_bias, image.position(i, j, k)));
  std::vector<float> values = values_in(image, where);
  if (values.empty()) return image;
  const float one = std::max(median(values), 1e-6F);
  for (float& value : image.values) value /= one;
  return image;
}

}  // namespace mammotwin
