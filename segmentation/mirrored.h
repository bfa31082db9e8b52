#pragma once

#include "segmentation/image/flipped.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What is seen in a mirror at the plane x = 0: left and right are exchanged.
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& x_in_lps) {
  return {-x_in_lps.x(), x_in_lps.y(), x_in_lps.z()};
}

inline Side mirrored(Side side) { return side == Side::left ? Side::right : Side::left; }

template <class T>
Volume<T> mirrored(const Volume<T>& image) {
  Volume<T> result = flipped(image);
  result.origin.x() = -image.position(image.size.x() - 1, 0, 0).x();
  return result;
}

BreastRegion mirrored(const BreastRegion& region);
Segmentation mirrored(const Segmentation& segmentation);

}  // namespace mammotwin
