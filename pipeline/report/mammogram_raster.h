#pragma once

#include "pipeline/report/patient_results.h"
#include "pipeline/report/section.h"

namespace mammotwin {

/// A mammogram as a section over (u, v) of its detector shows it, grey between its 2 % darkest and
/// 0.2 % brightest pixels there; light grey where there is no image.
Raster mammogram_raster(const RealMammogram& real, const Section& section, double pixel_mm);

}  // namespace mammotwin
