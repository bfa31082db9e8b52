#pragma once

#include "fitting/scan/scanned_breast.h"

namespace mammotwin {

/// The gel breast's skin by its formula, as triangles of about `step_mm`, in the frame of its scan
/// as read; it has no noise and no holes.
ScannedSkin true_skin(const ScannedBreast& breast, double step_mm);

}  // namespace mammotwin
