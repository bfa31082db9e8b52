#pragma once

#include "fitting/mesh/mesh_file.h"
#include "registration/compressed_view.h"
#include "registration/view_state.h"
#include "solver/compress.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mammotwin {

class NearbyEquilibria;

using Nodes = std::vector<HermiteMesh::Node>;

/// The compression at a state; only the mechanical numbers are looked at.
using ProblemAt = std::function<CompressionProblem(const ViewState&)>;

/// A compression with the view's frame that its plates make.
struct SolvedView {
  CompressionResult result;
  CompressedView view;
};

/// Frame of a view from where its plates ended.
CompressedView view_of_plates(const std::string& name, Side side, double angle_deg,
                              const PlateOptions& options, const CompressionResult& result);

/// What a standard deviation of each mechanical number does to the nodes in the view's frame, to
/// first order; empty where that is not known.
using Slopes = std::array<Nodes, kMechanical>;

/// Solves the view again near a solution that there is, with plates where the state puts them: contact
/// is softer than in `compress` (up to 0.5 mm) and the thickness comes out, so that a solve takes a
/// tenth. Empty where no equilibrium is found.
class NearbySolver {
 public:
  NearbySolver(SolvedView base, ProblemAt problem_at);

  const SolvedView& base() const { return base_; }  ///< as given
  std::optional<SolvedView> solve(const ViewState& state) const;

  /// At the base with the softer contact, by implicit differentiation
  /// (solver/press/nearby_equilibria.h), for standard deviations `sd`. Empty where that equilibrium
  /// is not there or not stable.
  std::optional<Slopes> slopes(const ViewState& sd) const;

 private:
  std::optional<SolvedView> solve_from(const CompressionResult& near, const ViewState& state) const;
  Nodes change_between(const NearbyEquilibria& nearby, const ViewState& from,
                       const ViewState& to) const;

  SolvedView base_;
  ProblemAt problem_at_;
  std::optional<SolvedView> soft_base_;  ///< the base with the softer contact
};

/// One view as a function of its state z, in standard deviations (`sd`):
///
///   x(z) = x0 + sum_i (z_i a_i + z_i^2 b_i),   a = (x+ - x-) / 2,   b = (x+ + x-) / 2 - x0
///
/// over nodal parameters in the view's own frame, from solves at z_i = +1 and -1; then turn and
/// shifts in the detector's plane, exactly. A number for which no solve succeeds has no effect.
struct ReducedView {
  struct Mode {
    Nodes linear, quadratic;  ///< empty: no effect
  };
  std::vector<HermiteMesh::Corners> elements;
  Nodes base;  ///< view coordinates [mm]
  std::array<Mode, kMechanical> modes;
  ViewState sd = prior_sd();
  int failed_solves = 0;

  /// Nodes in view coordinates; turn and shifts left out.
  Nodes nodes_at(const ViewState& z) const;

  /// Nodes at z moved on by the slope there of one mechanical number: x(z) + dx/dz_i.
  Nodes nodes_along_slope(const ViewState& z, int number) const;

  /// Turn and shifts of a point.
  Eigen::Vector3d placed(const Eigen::Vector3d& x_in_view, const ViewState& z) const;

  /// From here on x(z) is what was solved there.
  void rebase(const ViewState& z, const Nodes& solved_in_view);
};

/// From two solves a number.
ReducedView reduce_view(const NearbySolver& solver, const ViewState& sd);

/// Without a solve, a from `slopes` and b = 0: enough to say how sure a place is. A search needs
/// more: slopes change within a fraction of a standard deviation, as points touch and let go.
ReducedView linear_view(const NearbySolver& solver, const ViewState& sd);

/// Nodes of a mesh in LPS as they stand in a view's frame.
Nodes in_view(const Nodes& nodes, const ViewFrame& frame);

}  // namespace mammotwin
