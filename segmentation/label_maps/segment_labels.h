#pragma once

#include "segmentation/segment.h"

namespace mammotwin {

/// Labels and fractions of one side from a label map made elsewhere, lesions named after the
/// seeds. Region, nipple and quality are left to `segment`.
SegmentResult segment_labels(const SegmentInput& input);

}  // namespace mammotwin
