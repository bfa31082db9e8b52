#pragma once

#include "registration/prediction/affine_baseline.h"
#include "registration/search/model_discrepancy.h"
#include "registration/search/search_ellipse.h"
#include "registration/search/search_verdict.h"
#include "registration/search/view_refinement.h"
#include "registration/search/what_if.h"
#include "solver/progress.h"

namespace mammotwin {

/// A view before its search.
struct SearchInput {
  MeshFile file;  ///< what compress wrote: the compressed mesh, faces, "prone"
  CompressedView view;
  Detector detector;
  std::optional<NearbySolver> solver;    ///< absent: no sensitivities, and so no search
  std::optional<ViewEvidence> evidence;  ///< absent: there is no mammogram
};

/// What the search made of it. After `no_registration`, shape, frame and uncertainty are those of a
/// view without a mammogram; state and figures say where the search had ended.
struct SearchedView {
  CompressedView view;  ///< with the frame that lays the breast on its detector
  HermiteMesh compressed;
  AffineBaseline baseline;  ///< brought to the same outline and nipple by turn and shifts
  ViewUncertainty uncertainty{};
  WhatIfShapes what_if{};
  ViewState state = ViewState::Zero(), state_sd = ViewState::Zero();  ///< physical units
  std::optional<MatchFigures> before{}, after{}, baseline_left{};
  std::optional<ViewRefinement> refinement{};  ///< of a view that lies on its mammogram
  SearchVerdict verdict{};
  ModelDiscrepancy discrepancy{};  ///< of a view that was searched
  double evidence_variance = 1;    ///< PoseEstimate's
  bool complete = true;  ///< false: it stopped where no equilibrium was found, at its best so far
  int failed_solves = 0;
};

/// Sensitivities of every view, then one search over the states of those with a mammogram: each is
/// solved where the search on the reduced models ends, which go through that solve from then on,
/// until the solves bear out what the reduced models said or get no better.
std::vector<SearchedView> search_views(const std::vector<SearchInput>& inputs,
                                       const Volume<Fractions>& fractions,
                                       const Eigen::Vector3d& nipple_in_lps,
                                       const Progress& progress);

}  // namespace mammotwin
