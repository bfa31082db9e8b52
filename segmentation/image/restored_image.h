#pragma once

#include "segmentation/image/volume.h"

namespace mammotwin {

/// An image without the noise that grows where the coil sees little, and without the blur of a
/// voxel's width that scanning leaves. `noise`: standard deviation of each voxel; 0 where not
/// known.
Volume<float> restored_image(const Volume<float>& image, const Volume<float>& noise);

}  // namespace mammotwin
