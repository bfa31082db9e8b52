#pragma once

#include "registration/prediction/affine_baseline.h"
#include "registration/search/view_match.h"

namespace mammotwin {

struct PlacedBaseline {
  AffineBaseline baseline;
  std::optional<MatchFigures> left;  ///< to a mammogram, if there is one
};

/// The baseline of a compressed view, as its plates stand, turned and shifted to where the
/// detector's edge is expected; with evidence, from there to the mammogram's outline and nipple, as
/// the model is.
PlacedBaseline placed_baseline(const MeshFile& compressed, const CompressedView& view,
                               const Eigen::Vector3d& nipple_in_lps, const EdgePrior& edge,
                               const Detector& detector,
                               const std::optional<ViewEvidence>& evidence);

/// The prone breast of what compress wrote.
HermiteMesh prone_of(const MeshFile& compressed);

}  // namespace mammotwin
