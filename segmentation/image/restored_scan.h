#pragma once

#include "segmentation/image/volume.h"

namespace mammotwin {

/// A scan without the noise that grows where the coil sees little, and without the blur of a
/// voxel's width that scanning leaves. `noise`: standard deviation of each voxel of the scan; 0
/// where not known.
Volume<float> restored_scan(const Volume<float>& scan, const Volume<float>& noise);

}  // namespace mammotwin
