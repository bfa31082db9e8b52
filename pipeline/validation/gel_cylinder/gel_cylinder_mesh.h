#pragma once

#include "fitting/mesh/cylinder_mesh.h"
#include "solver/contact/contact_figures.h"

namespace mammotwin {

inline constexpr double kOnPlane = 1e-6;  // [mm]

/// What of the cylinder is meshed; the plates' normal is y or z.
enum class CylinderPart {
  eighth,  ///< x, y, z >= 0: three planes of symmetry
  half,    ///< y >= 0, z from -length/2 to length/2: one plate, as the paper ran it
};

/// A part of the cylinder about the z axis with its middle at 0 [mm]. `elements` count the whole
/// cross-section and half the length. Throws std::invalid_argument where the square's number is
/// odd, or the half is asked for graded along the axis.
MeshFile cylinder_part(double diameter, double length, const CylinderElements& elements,
                       CylinderPart part);

/// Faces whose corners all have component `axis` at `value` [mm] in the reference shape.
FaceList faces_in_plane(const HermiteMesh& mesh, int axis, double value);

/// Faces that carry a label.
FaceList faces_with_label(const MeshFile& file, FaceLabel label);

/// Node nearest to a place.
int node_at(const HermiteMesh& mesh, const Eigen::Vector3d& X);

}  // namespace mammotwin
