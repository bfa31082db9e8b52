#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// An MRI after a change that must not matter to what is found in it.
struct ChangedMri {
  Volume<float> image;
  bool mirrored = false;  ///< left is right in it
  /// Place [mm, LPS] in the changed image that shows what the given one of the first shows.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> changed_from_first =
      [](const Eigen::Vector3d& x) { return x; };
};

struct MriChange {
  std::string name;
  std::function<ChangedMri(const Volume<float>&, Side breast)> apply;
};

/// Mirrored; the body turned by 5 degrees either way about its long axis, and head up by 5 about
/// the left-right one (what comes into the image is its border's tissue); half a voxel off; voxels
/// of 0.8 and 1.3 times the edge; 12 mm fewer at head and feet; noise of 3 % of tissue; shading
/// from 1.25 to 0.75 from side to side and from front to back; grey values to the power 0.8; slices
/// of 2.5 mm across each axis; the breast alone, to 15 mm beyond the image's middle.
std::vector<MriChange> mri_changes();

}  // namespace mammotwin
