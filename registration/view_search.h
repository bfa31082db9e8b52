#pragma once

#include "registration/affine_baseline.h"
#include "registration/search_ellipse.h"

namespace mammotwin {

/// A view before its search.
struct SearchInput {
  MeshFile file;             ///< what compress wrote: the compressed mesh, faces, "prone"
  CompressedView view;
  Detector detector;
  std::optional<NearbySolver> solver;     ///< absent: no sensitivities, and so no search
  std::optional<ViewEvidence> evidence;   ///< absent: there is no mammogram
};

/// What the search made of it.
struct SearchedView {
  CompressedView view;       ///< with the frame that lays the breast on its mammogram
  HermiteMesh compressed;
  AffineBaseline baseline;   ///< brought to the same outline and nipple by turn and shifts
  ViewUncertainty uncertainty{};
  ViewState state = ViewState::Zero(), state_sd = ViewState::Zero();  ///< physical units
  std::optional<MatchFigures> before{}, after{};
  bool solved = true;        ///< false: no equilibrium at the state found; the reduced model's shape
  int failed_solves = 0;
};

/// Sensitivities of every view, then one search over the states of those with a mammogram, each
/// solved again where the search ends, searched once more round that and solved at last.
std::vector<SearchedView> search_views(const std::vector<SearchInput>& inputs,
                                       const Volume<Fractions>& fractions,
                                       const Eigen::Vector3d& nipple_in_lps,
                                       const Progress& progress);

}  // namespace mammotwin
