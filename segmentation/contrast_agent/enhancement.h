#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// `pre` at the voxels of `post`. Throws std::runtime_error where it covers less than 90 % of them.
Volume<float> on_grid_of(const Volume<float>& post, const Volume<float>& pre);

/// (post - pre) / pre of a dynamic study, 0 to 5; the coil's shading drops out. Where `pre` is
/// within three times the noise that takes its place. No motion between the two is corrected.
Volume<float> relative_enhancement(const Volume<float>& post, const Volume<float>& pre,
                                   double noise);

/// A part that takes up contrast agent: a lesion, a vessel, or a piece of the nipple.
struct LesionCandidate {
  Eigen::Vector3d centroid_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  double volume_ml = 0;
  double enhancement = 0;  ///< mean of (post - pre) / pre
};

/// Parts of 0.05 to 40 ml whose brightness doubles at least, within `allowed`; at most ten, by
/// volume times enhancement, largest first.
std::vector<LesionCandidate> find_candidates(const Volume<float>& enhancement,
                                             const Volume<std::uint8_t>& allowed);

}  // namespace mammotwin
