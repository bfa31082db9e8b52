#pragma once

#include "segmentation/volume.h"

namespace mammotwin {

/// The image without noise that differs from place to place: the u that minimises
///
///   sum (u - image)^2 / (2 noise^2) + strength sum |grad u| / noise
///
/// (Rudin, Osher and Fatemi, Physica D 60 (1992), 259-268, weighted), by the first-order
/// primal-dual algorithm (Chambolle and Pock, J. Math. Imaging Vis. 40 (2011), 120-145).
///
/// `noise`: standard deviation [image units] of each voxel. Where it is 0, nothing is known of the
/// image and u is what the voxels around it suggest. Differences are those of voxels, however long.
Volume<float> total_variation_denoised(const Volume<float>& image, const Volume<float>& noise,
                                       double strength);

}  // namespace mammotwin
