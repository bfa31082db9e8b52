#pragma once

#include "pipeline/steps/pressed_sides.h"
#include "solver/gravity/fit_skin_way.h"

namespace mammotwin {

/// What of a breast's skin is to go outward, and how far, so that it is as round as asked once its
/// coil lets it go.
struct CoilRelease {
  PressedSkin pressed;
  SkinWayFit fit;  ///< its figure is the Roundness
};

/// `imaged`: the breast as `unload` takes it. Empty where it is as round already, or no shape with
/// its skin farther out was found.
std::optional<CoilRelease> release_from_coil(const BreastProblem& imaged, const PressedSides& sides,
                                             double roundness, const Progress& progress = {});

/// Its shape free of load if it were rounder than that by so much; empty where none is found.
std::vector<HermiteMesh::Node> rounder_shape(const BreastProblem& imaged, const PressedSides& sides,
                                             const CoilRelease& release, double by);

}  // namespace mammotwin
