#include "segmentation/skin/skin_stage.h"

#include <algorithm>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/smoothing.h"
#include "segmentation/skin/skin.h"

namespace mammotwin {
namespace {

/// Voxels in and around the breast's skin, where it hangs free.
Volume<std::uint8_t> skin_layer(const Volume<std::uint8_t>& body, const BreastFrame& frame) {
  constexpr double outside_mm = 4, before_sternum_mm = 5;
  const Volume<float> to_body = distance_to(body);
  auto where = body.like<std::uint8_t>(0);
  for (int k = 0; k < where.size.z(); ++k)
    for (int j = 0; j < where.size.y(); ++j)
      for (int i = 0; i < where.size.x(); ++i) {
        const Eigen::Vector3d x = where.position(i, j, k);
        where(i, j, k) = x.y() < frame.sternal_y - before_sternum_mm && x.z() > frame.z_low &&
                         x.z() < frame.z_high && to_body(i, j, k) < outside_mm;
      }
  return where;
}

/// The part of `layer` under which fat begins, not darker than `darkest`: where gland lies at the
/// skin, neither it nor its blur is told from skin.
Volume<std::uint8_t> over_fat(const Volume<float>& image, const Volume<float>& depth,
                              const Volume<std::uint8_t>& layer, float darkest) {
  constexpr double from_mm = 3.5, to_mm = 5.2, neighbourhood_mm = 3, block_mm = 2.4;
  constexpr float brightest = 1.25F;  // fat is at 1, gland at 0.45 or 1.8
  auto below = layer;
  for (std::size_t v = 0; v < below.values.size(); ++v)
    below.values[v] = depth.values[v] > from_mm && depth.values[v] < to_mm;
  const Volume<float> around = smooth_field(image, below, block_mm, neighbourhood_mm);
  auto chosen = layer;
  for (int k = 0; k < layer.size.z(); ++k)
    for (int j = 0; j < layer.size.y(); ++j)
      for (int i = 0; i < layer.size.x(); ++i) {
        if (!layer(i, j, k)) continue;
        const Eigen::Vector3i block =
            around.index(layer.position(i, j, k)).array().round().cast<int>().matrix();
        const float here = around(block.x(), block.y(), block.z());
        chosen(i, j, k) = here > darkest && here < brightest;
      }
  return chosen;
}

}  // namespace

SkinStage find_skin(const Volume<float>& image, const Volume<std::uint8_t>& body,
                    const BreastFrame& frame) {
  constexpr double reach_mm = 5.5;
  // Dense gland leaves little fat under the skin, and darkens the mean there.
  constexpr double usual_share = 0.1, least_share = 0.05;
  constexpr float usually_darkest = 0.8F, darkest = 0.7F;
  auto share = body.like<float>(0);
  std::copy(body.values.begin(), body.values.end(), share.values.begin());
  const Volume<float> depth = signed_depth(std::move(share), reach_mm);
  const Volume<std::uint8_t> layer = skin_layer(body, frame);
  const auto is_enough = [&](const Volume<std::uint8_t>& part, double share_of_layer) {
    const auto count = [](const Volume<std::uint8_t>& mask) {
      return std::count(mask.values.begin(), mask.values.end(), std::uint8_t{1});
    };
    return count(part) > share_of_layer * static_cast<double>(count(layer));
  };
  Volume<std::uint8_t> fat = over_fat(image, depth, layer, usually_darkest);
  bool enough = is_enough(fat, usual_share);
  if (!enough) {
    fat = over_fat(image, depth, layer, darkest);
    enough = is_enough(fat, least_share);
  }
  const Volume<std::uint8_t>& where = enough ? fat : layer;
  SkinStage skin;
  skin.surface = find_skin_surface(image, body, where);
  skin.slab = measure_skin(image, skin.surface.depth, where);
  skin.slab.over_fat = enough;
  // Smoothing rounds the surface off by a tenth of a millimetre: depth counts from where skin
  // begins.
  for (float& depth : skin.surface.depth.values) depth -= static_cast<float>(skin.slab.surface);
  return skin;
}

}  // namespace mammotwin
