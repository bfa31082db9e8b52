#pragma once

#include "registration/search/view_match.h"

namespace mammotwin {

/// Over which displacements that no state explains are correlated: exp(-d^2 / (2 length^2)).
inline constexpr double kDisplacementLength_mm = 30;

/// What a deformation in the view's plane takes up of what a search left.
struct ViewRefinement {
  FreeFormDeformation deformation;
  MatchFigures left;               ///< with it
  double rms_mm = 0, most_mm = 0;  ///< displacements of what the detector sees
};

/// The most probable deformation of a view at the end of its search, and the match goes on with it.
///
/// A state moves all tissue together; what its few numbers cannot say (another law of tissue,
/// another chest wall) is left over as displacements that neighbours share. Their prior is normal
/// with standard deviation 2 mm, correlated over kDisplacementLength_mm. What is left of outline
/// and pattern before is taken for the noise of each, so that only what many cells and rays agree
/// on moves tissue.
ViewRefinement refine_view(ViewMatch& match, const ViewState& z);

}  // namespace mammotwin
