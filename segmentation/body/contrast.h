#pragma once

#include <cstdint>

#include "segmentation/body/breast_frame.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// What the image weighs, by the skin, which is brighter than the fat under it only where fat is
/// suppressed.
struct Contrast {
  bool fat_suppressed = false;
  double skin_over_fat = 0;  ///< brightest depth to 2 mm over the brightest from 2.5 to 4.5 mm
};

/// Compares medians at depths below the skin of the breasts and of the chest in front: so near the
/// skin there is hardly any gland, however dense the breast. `depth` is below the coarse outline,
/// which lies about a voxel outside the skin.
Contrast find_contrast(const Volume<float>& image, const Volume<float>& depth,
                       const BreastFrame& frame);

/// `depth` below skin that faces across voxels of at most `thick_mm`, 0 elsewhere: a thicker voxel
/// holds skin with air or fat.
Volume<float> depth_where_thin(const Volume<float>& depth, double thick_mm);

/// Is what is not fat brighter than it? Asked where the skin does not tell, of the whole body after
/// coarse bias correction: muscle, gland and heart are brighter than suppressed fat and darker than
/// other fat. Compares the shares of the body in classes of 1.15 times the fat under the skin and
/// more, and of 0.28 to 0.75 times (below lies the lung).
bool is_fat_outshone(const Volume<float>& image, const Volume<std::uint8_t>& body,
                     const Volume<float>& depth, const BreastFrame& frame);

/// Brightness of the fat 5 to 8.5 mm under that skin: the 30th percentile where fat is suppressed,
/// the 70th elsewhere, as what gland there is lies on the other side.
double subcutaneous_fat(const Volume<float>& image, const Volume<float>& depth,
                        const BreastFrame& frame, bool fat_suppressed);

}  // namespace mammotwin
