#pragma once

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

/// How far strain is from continuous: over all faces between two elements of a deformed mesh, the
/// root mean square of the jump of E = (FᵀF − 1)/2 (Frobenius norm), divided by that of E itself.
/// Faces are paired by the place of their points in `before`, whether or not they share nodes.
double strain_jump(const HermiteMesh& before, const HermiteMesh& after);

}  // namespace mammotwin
