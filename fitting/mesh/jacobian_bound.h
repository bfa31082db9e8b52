#pragma once

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// det(∂x/∂ξ) over a whole mesh, bounded and not sampled. In an element the determinant is a
/// polynomial of degree 8 along each ξ; it lies between its smallest and largest Bernstein
/// coefficient, and boxes are halved until that decides (Johnen, Remacle, Geuzaine,
/// J. Comput. Phys. 233 (2013) 359-372).
struct JacobianBound {
  double lower = 0;    ///< det ≥ lower everywhere, as a fraction of the mean determinant
  double sampled = 0;  ///< smallest determinant met at a box's corner, same unit
  bool proved() const { return lower > 0; }
};

/// Is det > 0 everywhere? Subdivides only where the sign is open, and stops at a negative value.
bool proved_valid(const HermiteMesh& mesh);

/// The bound of each element, sharpened until lower is within 0.01 of sampled and has its sign
/// (or 8 halvings are done).
std::vector<JacobianBound> bound_elements(const HermiteMesh& mesh);

/// The smallest over all elements.
JacobianBound bound_jacobian(const HermiteMesh& mesh);

/// det / (|∂₁x| |∂₂x| |∂₃x|), the smallest of each element over a grid of 7³ points; 1 in a brick.
std::vector<double> scaled_jacobians(const HermiteMesh& mesh);

}  // namespace mammotwin
