#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// x [mm, LPS] of the valley between two breasts in the labels; empty if there are not two.
std::optional<double> find_midline(const Volume<std::uint8_t>& labels);

/// True if a point is on that side of the midline.
bool is_on_side(double x, double midline, Side side);

/// Sets everything beyond the midline to air.
void keep_side(Volume<std::uint8_t>& labels, double midline, Side side);

/// Labels everything behind the front of the muscle as muscle, column by column; lesions stay.
/// Pieces of muscle of fewer than 2000 voxels have no front; they become fat.
void fill_behind_muscle(Volume<std::uint8_t>& labels);

/// The part of a volume from voxel `low` to voxel `high`, both included.
template <class T>
Volume<T> cropped(const Volume<T>& volume, const Eigen::Vector3i& low,
                  const Eigen::Vector3i& high) {
  Volume<T> out(high - low + Eigen::Vector3i::Ones(), volume.spacing,
                volume.position(low.x(), low.y(), low.z()));
  std::size_t n = 0;
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i) out.values[n++] = volume(i, j, k);
  return out;
}

/// Voxel box around everything that is not air, widened by `margin` voxels within the grid.
struct VoxelBox {
  Eigen::Vector3i low, high;
};
VoxelBox labelled_box(const Volume<std::uint8_t>& labels, int margin);

}  // namespace mammotwin
