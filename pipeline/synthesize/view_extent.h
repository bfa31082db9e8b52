#pragma once

#include "segmentation/segmentation.h"

namespace mammotwin {

/// How far the free breast reaches along a view's beam in front of the plates' edge [mm], which
/// lies 10 mm in front of the foremost chest wall of the region. The beam of positioner angle
/// theta runs from superior-medial to inferior-lateral; 0 is CC.
double extent_along_beam(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                         double angle_deg);

}  // namespace mammotwin
