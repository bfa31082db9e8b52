#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// A lesion found around a point.
struct FoundLesion {
  Volume<std::uint8_t> mask;                      ///< on a part of the image's grid
  Eigen::Vector3i low = Eigen::Vector3i::Zero();  ///< voxel of the image where that part begins
  double brightness = 0;                          ///< median of its inner part
  double background = 0;                          ///< median of the 2 to 6 mm around it
  double inscribed_mm = 0;                        ///< radius of the largest ball inside
  double agreement = 0;                           ///< Dice of half maximum and random walker
  Eigen::Vector3d extent_mm = Eigen::Vector3d::Zero();  ///< along x, y, z
  /// Where it is over 0.3 of its contrast rather than over half; 0 for a ball.
  Eigen::Vector3d soft_extent_mm = Eigen::Vector3d::Zero();
  bool is_sphere = false;  ///< nothing stood out: a ball of 5 mm was taken
  bool is_cut = false;     ///< it goes on where the search ends

  /// Does its extent hang on where its edge is drawn: by over 3 mm and 20 %?
  bool is_soft() const;
  double contrast() const { return background > 0 ? brightness / background : 0; }
};

struct LesionSearch {
  double reach_mm = 50;        ///< from the point; looked for within 30 mm first
  bool brighter = true;        ///< than what surrounds it
  bool random_walker = false;  ///< take the walker's answer instead of half maximum's
};

/// The voxels `low` to `high` of the image, without blur.
using SharpImage =
    std::function<Volume<float>(const Eigen::Vector3i& low, const Eigen::Vector3i& high)>;

/// Stops at the lesion's edge. Half maximum, iterated: threshold midway between the inner part and
/// the surroundings, the part that holds the brightest place within 6 mm of the point, opened by
/// half of its inscribed radius, 3 mm at most, so that vessels and ducts fall off. Smaller parts
/// that fell off with a neck of up to 6 mm stay if they are as bright: lobes, and tongues of 0.3 of
/// the inscribed radius that touch it. Not so of dark lesions, beside which gland is as dark. Last,
/// the voxels on either side of that part's surface are judged again by half maximum in the sharp
/// image: what is uneven inside would fall to pieces there, but blur hides the edge of what is
/// small or rough.
/// A random walker from the same core is the second opinion (random_walker.h).
FoundLesion find_lesion(const Volume<float>& image, const SharpImage& sharp,
                        const Volume<std::uint8_t>& allowed, const Eigen::Vector3d& point_in_lps,
                        const LesionSearch& search);

}  // namespace mammotwin
