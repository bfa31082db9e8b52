#include "segmentation/body/nipple.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/body/most_anterior_point.h"
#include "segmentation/image/components.h"
#include "segmentation/image/crop.h"
#include "segmentation/image/distance.h"
#include "segmentation/label_maps/label_values.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Mask = Volume<std::uint8_t>;

constexpr double ball_mm = 9;   // a papilla is 10 to 14 mm wide
constexpr double least_mm = 2;  // over the ball: less is the outline's own unevenness
constexpr double least_ml = 0.08, most_ml = 3;
constexpr double nearness_mm = 30;  // to the most anterior point
constexpr double reach_mm = 50;     // what lies farther off is not looked at
constexpr double tip_mm = 1;        // the tip is the middle of what stands out as far as this

/// The body around a point, within the region.
Mask body_near(const Mask& labels, const BreastRegion& region, const Vector3d& x) {
  const Vector3d reach = Vector3d::Constant(reach_mm + 2 * ball_mm);
  const Vector3i low = labels.index(x - reach).array().ceil().max(0).cast<int>();
  const Vector3i high = labels.index(x + reach)
                            .array()
                            .floor()
                            .min((labels.size.array() - 1).cast<double>())
                            .cast<int>();
  Mask body = cropped(labels, low, high);
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        std::uint8_t& value = body(i, j, k);
        value = value != label::air && region.contains(body.position(i, j, k));
      }
  return body;
}

struct Bump {
  double height = 0;
  std::size_t voxels = 0;
  Vector3d tip = Vector3d::Zero();
  int at_tip = 0;
};

/// Height, size and tip of each part that stands out.
std::vector<Bump> measure(const Components& parts, const Volume<float>& height) {
  std::vector<Bump> bumps(parts.sizes.size());
  for (std::size_t v = 0; v < height.values.size(); ++v)
    if (const int id = parts.ids.values[v]; id > 0)
      bumps[id].height = std::max<double>(bumps[id].height, height.values[v]), ++bumps[id].voxels;
  for (int k = 0; k < height.size.z(); ++k)
    for (int j = 0; j < height.size.y(); ++j)
      for (int i = 0; i < height.size.x(); ++i)
        if (const int id = parts.ids(i, j, k); id > 0)
          if (Bump& bump = bumps[id]; height(i, j, k) > bump.height - tip_mm)
            bump.tip += height.position(i, j, k), ++bump.at_tip;
  for (Bump& bump : bumps)
    if (bump.at_tip > 0) bump.tip /= bump.at_tip;
  return bumps;
}

}  // namespace

Nipple find_nipple(const Mask& labels, const BreastRegion& region) {
  const Vector3d front = most_anterior_point(labels, region);
  const Mask body = body_near(labels, region, front);
  const Mask smooth = opened(body, ball_mm);
  auto standing = body;
  for (std::size_t v = 0; v < standing.values.size(); ++v)
    standing.values[v] = body.values[v] && !smooth.values[v];
  Nipple best;
  best.tip_in_lps = front;
  double best_score = 0, rival_score = 0;
  int best_id = 0;
  const Components parts = connected_components(standing);
  const std::vector<Bump> bumps = measure(parts, distance_to(smooth));
  for (int id = 1; id < static_cast<int>(bumps.size()); ++id) {
    const Bump& bump = bumps[id];
    const double ml = static_cast<double>(bump.voxels) * body.voxel_volume() / 1000;
    const double away = (bump.tip - front).norm();
    if (bump.height < least_mm || ml < least_ml || ml > most_ml || away > reach_mm) continue;
    const double near = away / nearness_mm;
    const double score = bump.height * std::exp(-0.5 * near * near);
    if (score <= best_score) {
      if (score > rival_score) rival_score = score, best.rival_in_lps = bump.tip;
      continue;
    }
    rival_score = best_score;
    best.rival_in_lps = best.tip_in_lps;
    best_score = score;
    best_id = id;
    best.tip_in_lps = bump.tip;
    best.stands_out_mm = bump.height;
  }
  if (best_id == 0) return best;
  best.rival_share = rival_score / best_score;
  best.papilla = body.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < body.values.size(); ++v)
    best.papilla.values[v] = parts.ids.values[v] == best_id;
  return best;
}

void label_papilla(const Nipple& nipple, Segmentation& s) {
  const Mask& papilla = nipple.papilla;
  for (int k = 0; k < papilla.size.z(); ++k)
    for (int j = 0; j < papilla.size.y(); ++j)
      for (int i = 0; i < papilla.size.x(); ++i) {
        if (!papilla(i, j, k)) continue;
        const Vector3i v = s.labels.index(papilla.position(i, j, k)).array().round().cast<int>();
        std::uint8_t& value = s.labels(v.x(), v.y(), v.z());
        if (value != label::fibroglandular) continue;
        value = label::skin;
        s.fractions(v.x(), v.y(), v.z()) = pure_fractions(label::skin);
      }
}

}  // namespace mammotwin
