#pragma once

#include "segmentation/files/grid_image.h"
#include "segmentation/mri/dicom_series.h"

namespace mammotwin {

/// The series' pixels, rescaled, as one volume. Throws std::runtime_error, naming slices, where
/// they make no stack (slice_stack.h), have no pixel size or fewer pixels than they say.
GridImage load_series(const DicomSeries& series);

}  // namespace mammotwin
