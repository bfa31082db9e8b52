#pragma once

#include <Eigen/Geometry>

#include "fitting/mesh/hermite_mesh.h"
#include "registration/view/view_frame.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// For every voxel centre, where the tissue that stands there is in another configuration [mm];
/// NaN outside the mesh.
using PositionGrid = Volume<Eigen::Vector3d>;

/// Fills `grid` (any frame) with the positions in `target` of the tissue that stands at its voxel
/// centres in `here`: two configurations of one mesh, `here` in the frame of the grid. Same result
/// at any thread count.
void fill_positions(const HermiteMesh& here, const HermiteMesh& target, PositionGrid& grid);

/// The same mesh in view coordinates: (depth, lateral, height) take the places of (x, y, z).
HermiteMesh in_view_frame(const HermiteMesh& mesh, const ViewFrame& frame);

/// Box round a mesh [mm], exact to the hull of its Hermite control points.
Eigen::AlignedBox3d bounding_box(const HermiteMesh& mesh);

/// Empty grid of cubic voxels that cover the box.
PositionGrid cover(const Eigen::AlignedBox3d& box, double spacing_mm);

}  // namespace mammotwin
