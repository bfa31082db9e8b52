#pragma once

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// How many elements, and where the square ends.
struct CylinderElements {
  int square = 2;             ///< along each side of the central square, at least 1
  int ring = 1;               ///< radially between square and skin, at least 1
  int length = 4;             ///< along the axis, at least 1
  double square_part = 0.5;   ///< half side of the square / radius, in (0, 0.7)
  double ring_grading = 1;    ///< size at the skin / size at the square, radially, positive
  double length_grading = 1;  ///< size at z = length / size at z = 0, positive
};

/// Solid cylinder about the z axis, z from 0 to length [mm]: a square in a circle.
///
///        ξ₂ ┌───────┐           Four patches of ring elements lie round the square. In each
///         ╲ │   B   │ ╱         patch ξ₁ runs towards +x and ξ₂ towards +y in the square's sense,
///       C  ┌─┴─────┴─┐          so ring and square share nodes along the square's sides: C¹.
///          │ square  │ A        On the diagonals, where two ring patches meet, each patch has its
///          └─┬─────┬─┘          own nodes, tied so that the map stays C¹; on the four lines at
///         ╱ │   D   │ ╲         the square's corners the ties keep it C⁰.
///
/// ξ₃ runs along the axis. The mantle deviates from the circle by less than 3e-4 radius for
/// square = 1 and 5e-6 for square = 2. Mantle faces are labelled skin, end faces cut.
MeshFile cylinder_mesh(double radius, double length, const CylinderElements& elements);

}  // namespace mammotwin
