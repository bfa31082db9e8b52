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

/// `imaged`: the breast as `unload` takes it; `roundness`: what it is to have free of load. Where
/// nobody says, one less round than 0.5 gets 0.8, one from kFlat on (in which plates show, but did
/// little) stays as it is, between them in proportion.
/// Empty where it is as round already, or no shape with its skin farther out was found.
std::optional<CoilRelease> release_from_coil(const BreastProblem& imaged, const PressedSides& sides,
                                             std::optional<double> roundness,
                                             const Progress& progress = {});

/// The breast unloaded, let go as far as that says, or a half or a quarter as far: no farther than
/// that, loaded again, it rests where it was imaged. What came of it is put into the problem and
/// the release. Where nothing did, the release is empty and gravity alone is taken off.
UnloadResult unload_released(BreastProblem& problem, const PressedSides& sides,
                             std::optional<CoilRelease>& release, const Progress& progress = {});

/// The shape that `unload` found of the released breast (problem.pressed is set) under a share of
/// its gravity, if it were rounder by so much, to first order.
std::vector<HermiteMesh::Node> rounder_shape(const BreastProblem& released,
                                             const PressedSides& sides, const UnloadResult& found,
                                             double gravity_share, double by);

}  // namespace mammotwin
