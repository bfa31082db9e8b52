#pragma once

#include "fitting/fit_breast.h"
#include "fitting/solve/fit_samples.h"

namespace mammotwin {

/// What one slab is fitted to.
struct FitGoal {
  const TriangleSurface& skin;
  const FlatSkin& flat;
  const HeightField& wall;
  BreastRegion region;
  Eigen::Vector3d nipple_in_lps;
};

/// How a fit ended.
struct FittedMesh {
  HermiteMesh mesh;    ///< the last one, valid or not
  bool valid = false;  ///< det(∂x/∂ξ) > 0 is proved
};

/// Columns gathered round the nipple, as many as asked.
Slab slab_around_nipple(const Eigen::Vector3i& elements, const FitGoal& goal);

/// From straight rays to a valid mesh near the data, stage by stage (fitting/README.md). Adds its
/// course to the report, whose `smoothing` it takes.
FittedMesh fit_mesh(const Slab& slab, const FitGoal& goal, const FitOptions& options,
                    FitReport& report, const FitProgress& progress);

}  // namespace mammotwin
