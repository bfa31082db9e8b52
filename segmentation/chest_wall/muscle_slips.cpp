#include "segmentation/chest_wall/muscle_slips.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"

namespace mammotwin {
namespace {

constexpr float core_mm = 1.6F;   // from the core's surface to gland's: vessels and ducts have none
constexpr double least_ml = 0.3;  // of the core
constexpr double begins_mm = 6.5;  // from the wall: its blur and the core's distance, and 3 mm
constexpr double ends_mm = 15;     // nine tenths of the core: no muscle stands further off
constexpr double nearly_all = 0.9;
constexpr double gap_mm = 3;                           // between pieces, as noise leaves them
constexpr double as_bright = 1.25;                     // times muscle, or its inverse
constexpr float muscle_from_mm = 2, muscle_to_mm = 8;  // behind the wall

/// Median brightness of what lies just behind the wall in front of the breast.
double muscle_brightness(const HalfBreast& half, const Volume<float>& image) {
  const Volume<float> behind = distance_to(half.inside);
  auto muscle = half.body.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < muscle.values.size(); ++v)
    muscle.values[v] =
        half.body.values[v] && behind.values[v] > muscle_from_mm && behind.values[v] < muscle_to_mm;
  return median_in(image, muscle);
}

struct Core {
  double sum = 0;
  std::vector<float> above_wall;
};

std::vector<std::uint8_t> are_slips(const Components& parts, const HalfBreast& half,
                                    const Volume<float>& image, double muscle) {
  std::vector<Core> cores(parts.sizes.size());
  for (std::size_t v = 0; v < image.values.size(); ++v) {
    const std::int32_t part = parts.ids.values[v];
    if (part == 0) continue;
    cores[part].sum += image.values[v];
    cores[part].above_wall.push_back(half.above_wall.values[v]);
  }
  std::vector<std::uint8_t> is_slip(cores.size(), 0);
  for (std::size_t part = 1; part < cores.size(); ++part) {
    std::vector<float>& away = cores[part].above_wall;
    const double voxels = static_cast<double>(away.size());
    if (voxels * image.voxel_volume() / 1000 < least_ml) continue;
    std::sort(away.begin(), away.end());
    const double brightness = cores[part].sum / voxels / muscle;
    is_slip[part] = away.front() < begins_mm &&
                    away[static_cast<std::size_t>(nearly_all * (voxels - 1))] < ends_mm &&
                    std::abs(std::log(brightness)) < std::log(as_bright);
  }
  return is_slip;
}

/// True if a mask's voxel lies further out on the ray through x.
bool lies_before(const Volume<std::uint8_t>& mask, const PectoralWall& wall,
                 const Eigen::Vector3d& x) {
  const Eigen::Vector3d out =
      Eigen::Vector3d(x.x() - wall.axis_x, x.y() - wall.axis_y, 0).normalized();
  for (double mm = 0; mm < ends_mm; mm += mask.spacing.minCoeff() / 2) {
    const Eigen::Vector3i v = mask.index(x + mm * out).array().round().cast<int>();
    if (mask.contains(v.x(), v.y(), v.z()) && mask(v.x(), v.y(), v.z())) return true;
  }
  return false;
}

}  // namespace

Volume<std::uint8_t> muscle_before_wall(const HalfBreast& half, const PectoralWall& wall,
                                        const Volume<float>& gland_fraction,
                                        const Volume<float>& image) {
  auto gland = half.inside.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < gland.values.size(); ++v)
    gland.values[v] = gland_fraction.values[v] > 0.5F;
  auto slips = eroded(gland, core_mm);
  const Components parts = connected_components(slips);
  const std::vector<std::uint8_t> is_slip =
      are_slips(parts, half, image, muscle_brightness(half, image));
  for (std::size_t v = 0; v < slips.values.size(); ++v)
    slips.values[v] = is_slip[parts.ids.values[v]];
  slips = closed(dilated(slips, core_mm), gap_mm);
  auto muscle = slips.like<std::uint8_t>(0);
  tbb::parallel_for(0, muscle.size.z(), [&](int k) {
    for (int j = 0; j < muscle.size.y(); ++j)
      for (int i = 0; i < muscle.size.x(); ++i)
        muscle(i, j, k) = half.inside(i, j, k) && half.above_wall(i, j, k) < 2 * ends_mm &&
                          lies_before(slips, wall, muscle.position(i, j, k));
  });
  return muscle;
}

}  // namespace mammotwin
