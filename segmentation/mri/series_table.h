#pragma once

#include <vector>

#include "segmentation/mri/dicom_series.h"
#include "segmentation/mri/series_choice.h"

namespace mammotwin {

/// A row for each series, from headers and from how it looks (of a dynamic study the first two
/// phases: the others look alike). `all` must not be empty.
std::vector<SeriesRow> series_table(const std::vector<DicomSeries>& all);

}  // namespace mammotwin
