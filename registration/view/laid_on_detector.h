#pragma once

#include "registration/view/compressed_view.h"

namespace mammotwin {

/// The view's frame once the breast is turned on the detector, from depth towards lateral, and then
/// shifted in depth and lateral [mm]; the plates stay as they are.
CompressedView laid_on_detector(CompressedView view, double turn_deg,
                                const Eigen::Vector2d& shift_mm);

}  // namespace mammotwin
