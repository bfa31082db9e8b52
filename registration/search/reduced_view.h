#pragma once

#include <vector>

#include "registration/search/edge_prior.h"
#include "registration/search/free_form_deformation.h"
#include "registration/search/nearby_solver.h"
#include "registration/view/plates_edge.h"

namespace mammotwin {

/// One view as a function of its state z, in standard deviations (`sd`):
///
///   x(z) = x0 + sum_i (z_i a_i + z_i^2 b_i)
///
/// over nodal parameters in the view's own frame, through solves at z_i = +1 and -1, or half of
/// that where no equilibrium is found so far off; on one side only, then b = 0. Then turn and
/// shifts in the detector's plane, exactly, after what a refinement adds (view_refinement.h). A
/// number for which no solve succeeds has no effect.
struct ReducedView {
  struct Mode {
    Nodes linear, quadratic;  ///< empty: no effect
  };
  std::vector<HermiteMesh::Corners> elements;
  Nodes base;  ///< view coordinates [mm]
  std::array<Mode, kMechanical> modes;
  ViewState sd = prior_sd();
  EdgePrior edge;  ///< of the place on the detector
  int failed_solves = 0;
  FreeFormDeformation deformation;  ///< of each x(z)

  /// Nodes in view coordinates; turn and shifts left out.
  Nodes nodes_at(const ViewState& z) const;

  /// Nodes at z moved on by the slope there of one mechanical number: x(z) + dx/dz_i.
  Nodes nodes_along_slope(const ViewState& z, int number) const;

  /// Deformation, turn and shifts of a point that the modes brought to `x_in_view`.
  Eigen::Vector3d placed(const Eigen::Vector3d& x_in_view, const ViewState& z) const;

  PlatesEdge plates_edge(const ViewState& z) const;

  /// Takes the prior of the place on the detector from there.
  void expect(const EdgePrior& expected);

  /// The prior's, where a search begins [sd].
  ViewState mean() const { return edge.mean.cwiseQuotient(edge.sd); }

  /// From here on x(z) is what was solved there, without a deformation.
  void rebase(const ViewState& z, const Nodes& solved_in_view);

 private:
  Nodes undeformed_at(const ViewState& z) const;
  Nodes deformed(Nodes nodes) const;
};

/// From two solves a number.
ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd);

/// The same of these numbers alone; the others have no effect.
ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd,
                        const std::vector<int>& numbers);

/// Without a solve, a from `slopes` and b = 0: enough to say how sure a place is. A search needs
/// more: slopes change within a fraction of a standard deviation, as points touch and let go.
ReducedView linear_view(const NearbySolver& solver, const ViewState& sd);

}  // namespace mammotwin
