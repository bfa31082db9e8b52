#pragma once

#include <utility>
#include <vector>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// The mesh with its chest-wall faces smoothed; what does not lie on them stays.
///
/// Tissue that slides on a wall feels each of its hollows: where a fitted wall is uneven by a
/// millimetre every few centimetres, tissue that hangs from it rolls into the next one. The smooth
/// wall S is the minimum of
///
///     ∫ |S − S₀|² + ℓ⁴ (|S,₁₁|² + 2 |S,₁₂|² + |S,₂₂|²) dA
///
/// by lengths along the faces, free at its rim: a wave of length λ keeps 1/(1 + (2πℓ/λ)⁴) of its
/// height. length ℓ > 0 [mm]; faces: (element, face).
HermiteMesh with_smooth_wall(const HermiteMesh& mesh, const std::vector<ParameterTie>& ties,
                             const std::vector<std::pair<int, int>>& faces, double length);

}  // namespace mammotwin
