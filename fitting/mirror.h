#pragma once

#include "fitting/fit_breast.h"

namespace mammotwin {

/// What a skin is on the other side of the plane x = 0 (segmentation/mirrored.h).
ScannedSkin mirrored(const ScannedSkin& scan);

/// Of a fit whose mesh is a slab of `report.elements`: elements are numbered anew, so that ξ₁ runs
/// with x there, too.
FitResult mirrored(const FitResult& fit);

}  // namespace mammotwin
