#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "registration/view/view_frame.h"

namespace mammotwin {

/// Lateral place [mm] in the view of the middle between the two ends of what lies in front of the
/// detector's edge: a radiographer lays it on the detector's middle. Throws std::invalid_argument
/// if nothing lies there.
double outline_middle_mm(const HermiteMesh& pressed, const ViewFrame& view);

}  // namespace mammotwin
