#pragma once

#include "segmentation/segment.h"

namespace mammotwin {

/// Labels, fractions, lesions and the corrected image of one side from an MRI. Region, nipple and
/// volumes are left to `segment`.
SegmentResult segment_mri(const SegmentInput& input, const SegmentOptions& options,
                          const SegmentProgress& progress);

}  // namespace mammotwin
