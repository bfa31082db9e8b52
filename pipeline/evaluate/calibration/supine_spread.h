#pragma once

#include <vector>

#include "pipeline/evaluate/calibration/womens_moves.h"

namespace mammotwin {

/// How far landmarks go against their nipple as women lie back: root mean square by component
/// (lateral, posterior, along the body), over their distance from it.
Eigen::Vector3d supine_spread(const std::vector<WomensLandmark>& landmarks);

/// Share of landmarks that an ellipsoid holds which stands where they were prone, seen from the
/// nipple, with `times` that spread of their distance as semi-axes.
double share_held(const std::vector<WomensLandmark>& landmarks, const Eigen::Vector3d& spread,
                  double times);

}  // namespace mammotwin
