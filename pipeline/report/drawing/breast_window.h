#pragma once

#include <Eigen/Geometry>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// The part of the image that the page shows: the mesh (else the breast's region) and every lesion
/// with a margin of 12 mm, inside the image [mm, LPS]. Needs `results.segmentation`.
Eigen::AlignedBox3d breast_box(const PatientResults& results);

/// Grey values between which an image is shown.
struct GreyWindow {
  float low = 0, high = 1;

  /// 0 at `low` or darker, 1 at `high` or brighter.
  double of(float value) const;
};

/// Between the 1 % darkest and the 0.5 % brightest voxels of the box.
GreyWindow grey_window(const Volume<float>& image, const Eigen::AlignedBox3d& box);

/// Value of the voxel that holds the point [LPS], `outside` where there is none.
template <class T>
T nearest(const Volume<T>& volume, const Eigen::Vector3d& x, T outside) {
  const Eigen::Vector3i v = volume.index(x).array().round().template cast<int>();
  return volume.contains(v.x(), v.y(), v.z()) ? volume(v.x(), v.y(), v.z()) : outside;
}

}  // namespace mammotwin
