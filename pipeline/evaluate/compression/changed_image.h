#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// A change of what goes into a compression: of a kind that must not change what comes out of it,
/// or other tissue, which does.
struct InputChange {
  std::string name;         ///< "turn_5"
  double turn_deg = 0;      ///< the image turned about the body's long axis, and back
  bool mirror = false;      ///< left and right
  bool half_voxel = false;  ///< resampled on a grid that stands half a voxel off
  int more_elements = 0;    ///< of the mesh in each direction
  double thicker_mm = 0;
  std::string preset = {};  ///< materials.preset of the tissue; default as it is
  bool of_image() const { return turn_deg != 0 || mirror || half_voxel; }
};

/// turn_1, turn_3, turn_5, mirror, half_voxel, elements, thickness.
const std::vector<InputChange>& input_changes();

/// The image with the change made to it. A resampled voxel of a label map takes the label with the
/// largest share of the trilinear weights about its place; one of grey values that of a cubic
/// spline through them, not below zero.
Volume<std::uint16_t> changed_image(const Volume<std::uint16_t>& labels, const InputChange& change);
Volume<float> changed_image(const Volume<float>& grey, const InputChange& change);

/// x of the plane about which `mirror` reflects: the middle of the grid [mm].
template <class T>
double mirror_plane(const Volume<T>& image) {
  return image.origin.x() + image.spacing.x() * (image.size.x() - 1) / 2;
}

}  // namespace mammotwin
