#include "segmentation/chest_wall/half_breast.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "segmentation/body/body_mask.h"
#include "segmentation/image/distance.h"

namespace mammotwin {
namespace {

constexpr double kept_behind_sternum_mm = 100;
constexpr double skin_mm = 4, wall_mm = 2;

}  // namespace

VoxelBox side_box(const Volume<float>& image, const BreastFrame& frame, Side side) {
  constexpr double rounding = 1e-6;
  const double at = (frame.midline_x - image.origin.x()) / image.spacing.x();
  const int middle = std::clamp(
      static_cast<int>(side == Side::left ? std::ceil(at - rounding) : std::floor(at + rounding)),
      0, image.size.x() - 1);
  const int rear =
      std::clamp(static_cast<int>((frame.sternal_y + kept_behind_sternum_mm - image.origin.y()) /
                                  image.spacing.y()),
                 0, image.size.y() - 1);
  VoxelBox box{Eigen::Vector3i::Zero(), {image.size.x() - 1, rear, image.size.z() - 1}};
  (side == Side::left ? box.low.x() : box.high.x()) = middle;
  return box;
}

HalfBreast half_breast(const Volume<std::uint8_t>& body, const PectoralWall& wall, Side side) {
  HalfBreast half{side, body, body, depth_below_surface(body), {}};
  auto behind = body.like<std::uint8_t>(0);
  tbb::parallel_for(0, body.size.z(), [&](int k) {
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i) {
        if (!body(i, j, k)) continue;
        behind(i, j, k) = wall.is_behind(body.position(i, j, k));
        half.inside(i, j, k) = !behind(i, j, k);
      }
  });
  half.above_wall = distance_to(behind);
  return half;
}

Volume<std::uint8_t> pure_interior(const HalfBreast& half) {
  auto where = half.inside;
  for (std::size_t v = 0; v < where.values.size(); ++v)
    where.values[v] &= half.depth.values[v] > skin_mm && half.above_wall.values[v] > wall_mm;
  return where;
}

}  // namespace mammotwin
