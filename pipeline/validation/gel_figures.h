#pragma once

#include "pipeline/report/drawing/picture.h"
#include "pipeline/validation/gel_result.h"

namespace mammotwin {

/// Outlines before and after as a camera sees them (paper, figure ii): along the cylinder's axis,
/// and from its side. For a lying cylinder.
Picture outline_picture(const GelResult& result);

/// Force against unknowns, with the band of the other codes.
Picture convergence_picture(const GelResult& result);

/// Force against thickness, with the other codes' points.
Picture curve_picture(const GelResult& result);

}  // namespace mammotwin
