#pragma once

#include <optional>

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
struct FitCourse {
  HermiteMesh mesh;    ///< the last one, valid or not
  bool valid = false;  ///< det(∂x/∂ξ) > 0 is proved
};

/// Columns gathered round the nipple, as many as asked.
Slab slab_around_nipple(const Eigen::Vector3i& elements, const FitGoal& goal);

/// From straight rays to a valid mesh near the data, by the recipe of fitting/README.md. Adds steps
/// and distances to the report.
FitCourse fit_slab(const Slab& slab, const FitGoal& goal, double shape, double smoothing,
                   FitReport& report, const FitProgress& progress);

}  // namespace mammotwin
