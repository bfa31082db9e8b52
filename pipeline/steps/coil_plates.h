#pragma once

#include <optional>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// What immobilising plates of a breast coil leave on a breast that does not hang free: skin that
/// is plane on both sides.
struct CoilPlates {
  double left_cm2 = 0, right_cm2 = 0;  ///< of plane skin on the patient's left and right (LPS)
  double apart_mm = 0;
};

/// Looks on both sides of the imaged breast for its largest plane patch: skin within 1 mm of a
/// plane and 6 degrees of its normal, which runs within 45 degrees of left or right. Empty unless
/// both are larger, and more parallel, than those of breasts that hang free.
std::optional<CoilPlates> find_coil_plates(const MeshFile& imaged);

}  // namespace mammotwin
