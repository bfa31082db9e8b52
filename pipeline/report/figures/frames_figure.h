#pragma once

#include "pipeline/report/figure.h"

namespace mammotwin {

/// Every frame from LPS to the detector's pixels, drawn with the functions that compute them.
Figure frames_figure();

}  // namespace mammotwin
