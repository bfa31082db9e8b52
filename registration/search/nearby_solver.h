#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "registration/search/state_walk.h"
#include "registration/search/view_state.h"
#include "solver/press/compression_problem.h"

namespace mammotwin {

class NearbyEquilibria;

using Nodes = std::vector<HermiteMesh::Node>;

/// The compression at a state; only the mechanical numbers are looked at.
using ProblemAt = std::function<CompressionProblem(const ViewState&)>;

/// What a standard deviation of each mechanical number does to the nodes in the view's frame, to
/// first order; empty where that is not known.
using Slopes = std::array<Nodes, kMechanical>;

/// Solves the view again near a solution that there is, with plates where the state puts them:
/// contact is softer than in `compress` (up to 0.5 mm) and the thickness comes out, so that a solve
/// takes a tenth.
class NearbySolver {
 public:
  NearbySolver(SolvedView base, ProblemAt problem_at);

  const SolvedView& base() const { return base_; }  ///< as given

  CompressionProblem problem_at(const ViewState& state) const { return problem_at_(state); }

  /// The view of a solution at a state. The breast's middle keeps its place along the plates' edge,
  /// so that the view is a smooth function of the angle. (`view_of_plates` puts the middle of the
  /// outline's two ends there, which moves by tenths of a millimetre within a tenth of a degree
  /// wherever another bump of the skin reaches furthest.)
  CompressedView view_at(const ViewState& state, const PlateOptions& plates,
                         const CompressionResult& result) const;

  /// The base with the softer contact; empty where that finds no equilibrium.
  const std::optional<SolvedView>& soft_base() const { return soft_base_; }

  /// From the soft base, which must be there, as far towards a state as equilibria are found.
  Walk walk_to(const ViewState& state, double shortest = 0.5) const;

  /// The same from a solution at another state.
  Walk walk_from(const SolvedView& solved, const ViewState& at, const ViewState& to,
                 double shortest) const;

  /// The end of `walk_to` if that is the state; empty where no equilibrium is found.
  std::optional<SolvedView> solve(const ViewState& state) const;

  /// At the base with the softer contact, by implicit differentiation
  /// (solver/press/nearby_equilibria.h), for standard deviations `sd`; 0: not a number of this
  /// breast. Empty where that equilibrium is not there or not stable.
  std::optional<Slopes> slopes(const ViewState& sd) const;

 private:
  std::optional<SolvedView> solve_from(const CompressionResult& near, const ViewState& state) const;
  Nodes change_between(const NearbyEquilibria& nearby, const ViewState& from,
                       const ViewState& to) const;

  SolvedView base_;
  ProblemAt problem_at_;
  std::optional<SolvedView> soft_base_;  ///< the base with the softer contact
};

/// Nodes of a mesh in LPS as they stand in a view's frame.
Nodes in_view(const Nodes& nodes, const ViewFrame& frame);

/// The way back.
Nodes in_lps(Nodes nodes, const ViewFrame& frame);

}  // namespace mammotwin
