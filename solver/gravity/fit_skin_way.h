#pragma once

#include "solver/gravity/unload.h"

namespace mammotwin {

/// A figure of the breast's shape free of load that grows as its pressed skin goes outward.
using ShapeFigure = std::function<double(const std::vector<HermiteMesh::Node>& unloaded)>;

struct SkinWayFit {
  double way_mm = 0;  ///< for PressedSkin::way_mm
  double figure = 0;  ///< of the shape free of load then
  int trials = 0;
  std::string reason;  ///< why the figure is not the one wanted; empty otherwise
};

/// How far `imaged.pressed` must go outward for the shape free of load to have that figure, from
/// 0 to 60 mm, to 0.001 of the figure. Where that is not reached, the farthest way that was solved.
SkinWayFit fit_skin_way(const BreastProblem& imaged, const ShapeFigure& figure, double wanted,
                        const UnloadOptions& options, const Progress& progress = {});

}  // namespace mammotwin
