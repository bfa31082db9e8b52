#include "segmentation/segment_mri.h"

#include <stdexcept>

namespace mammotwin {

SegmentResult segment_mri(const SegmentInput& input, const SegmentOptions&,
                          const SegmentProgress&) {
  throw std::runtime_error(input.mri->string() +
                           ": segmentation from the image itself is not built in; expected a "
                           "label map beside it (labels.path in patient.toml)");
}

}  // namespace mammotwin
