#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "registration/view/view_frame.h"

namespace mammotwin {

/// Lateral place [mm] in the view of the centre of the tissue that lies in front of the detector's
/// edge: a radiographer lays it on the detector's middle. What ends at the model's cut faces near
/// the edge weighs little, so that it hangs little on where those are. Throws std::invalid_argument
/// if nothing lies there.
double breast_middle_mm(const HermiteMesh& pressed, const ViewFrame& view);

}  // namespace mammotwin
