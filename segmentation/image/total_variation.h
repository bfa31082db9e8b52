#pragma once

#include "segmentation/image/volume.h"

namespace mammotwin {

/// The image without noise that differs from place to place, and without blur: the u that minimises
///
///   sum (G u - image)^2 / (2 noise^2) + strength sum |grad u| / noise
///
/// (Rudin, Osher and Fatemi, Physica D 60 (1992), 259-268, weighted), by a first-order primal-dual
/// algorithm with a step of its own for each voxel (Condat, J. Optim. Theory Appl. 158 (2013),
/// 460-479; Pock and Chambolle, ICCV 2011, 1762-1769).
///
/// `noise`: standard deviation [image units] of each voxel. Where it is 0, nothing is known of the
/// image and u is what the voxels around it suggest. Differences are those of voxels, however long.
/// `blur_voxels`: standard deviation of the blur G [voxels], at most 0.7; three taps along each
/// axis.
Volume<float> total_variation_restored(const Volume<float>& image, const Volume<float>& noise,
                                       double strength, double blur_voxels);

}  // namespace mammotwin
