#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "registration/view/view_frame.h"

namespace mammotwin {

/// How far a breast escaped from the plates that press it, sideways and backwards.
struct PlateEscape {
  double swing_mm = 0;  ///< of the nipple along the plates' edges, lateral positive
  double roll_deg = 0;  ///< of the tissue between the plates, about an axis in their plane
  double slid_mm = 0;   ///< backwards, in the mean, of the tissue that was in front of their edges
};

/// From the breast as the plates found it to the breast between them, both on the same elements.
/// The roll is that of the beam's direction under the rotation of the affine map that fits the
/// tissue in front of the plates' edges best (its polar decomposition).
PlateEscape plate_escape(const HermiteMesh& found, const HermiteMesh& pressed,
                         const MeshPoint& nipple, const ViewFrame& view);

}  // namespace mammotwin
