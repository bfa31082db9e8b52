#pragma once

#include "fitting/mesh/mesh_file.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {

/// How far a radiographer turns plates about the beam so that the breast comes out straight between
/// them: `CompressedView::turn_deg` of a view with these axes [deg].
///
/// Of two directions the middle: the chest wall's mean normal, along which tissue comes out, each
/// piece of the wall weighted by its area and by exp(-r^2 / 2 (60 mm)^2), r its distance from the
/// nipple; and the breast's own axis, from the middle of the wall to the nipple. Where a coil
/// pressed, the first is too steep and the second too straight. Both turn with the body, so that
/// its place in the scanner is of no account. Throws std::invalid_argument if no chest wall faces
/// the plates.
double straight_turn_deg(const MeshFile& unloaded, const MeshPoint& nipple,
                         const Eigen::Matrix3d& view_axes);

/// The plates' turn where nothing is said: straight. How a detector is turned further in oblique
/// views, by its muscle, edge_prior.h says.
double usual_turn_deg(const MeshFile& unloaded, const MeshPoint& nipple, Side side,
                      double angle_deg);

/// Axes of a view with plates so turned.
Eigen::Matrix3d usual_axes(const MeshFile& unloaded, const MeshPoint& nipple, Side side,
                           double angle_deg);

}  // namespace mammotwin
