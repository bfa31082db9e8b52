#pragma once

#include "segmentation/half_breast.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// The image that tissue is told apart in, with the standard deviation of its noise.
struct TissueScan {
  Volume<float> image, noise;
};

/// The scan; or, of images before and after contrast agent, their mean, because fat and gland
/// hardly change and half of the noise's square is gone. Where the patient moved in between the one
/// after it is taken alone, and the doubt goes to `quality`, for lesions are outlined in the
/// difference.
TissueScan tissue_scan(const HalfBreast& half, SegmentQuality& quality);

}  // namespace mammotwin
