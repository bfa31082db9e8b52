#pragma once

#include "segmentation/segment.h"

namespace mammotwin {

/// A seed with its files read: a point, or a set of voxels on a grid of its own.
struct PlacedSeed {
  std::string id;
  Eigen::Vector3d point_in_lps;              ///< [mm]; of a label map: the centroid
  std::optional<double> radius_mm;           ///< of a sphere
  std::optional<Volume<std::uint8_t>> mask;  ///< of a label map

  /// True if x lies in the sphere or in the mask.
  bool holds(const Eigen::Vector3d& x_in_lps) const;
};

/// Throws std::runtime_error or std::invalid_argument naming the lesion where it has no place, a
/// file cannot be read, or a label map lacks the value.
PlacedSeed place_seed(const LesionSeed& seed);

PlacedSeed mirrored(PlacedSeed seed);  ///< segmentation/mirrored.h

}  // namespace mammotwin
