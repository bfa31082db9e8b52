#pragma once

#include <vector>

#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/newton/newton.h"
#include "solver/press/compression_problem.h"
#include "solver/press/pressed_breast.h"

namespace mammotwin {

/// Turns of the paddle that its spring still asks for when it counts as balanced [deg].
constexpr double kTiltTolerance = 0.05;
/// Of moment / spring − tilt over tilt: a guess to start a secant with.
constexpr double kTiltSlope = -1.5;

/// A breast and the two plates about it: moves the plates, measures what they do, and brings the
/// breast to equilibrium between them. It has no load history but friction's.
class Press {
 public:
  enum PlateNumber { kSupport, kPaddle };
  /// Penetration that is left [mm]: far less than an edge's rounding, so that tissue keeps to its
  /// side.
  static constexpr double kDeepest = 0.5;

  /// Throws std::invalid_argument that names what is wrong with the problem. It must outlive this.
  Press(const CompressionProblem& problem, const CompressionOptions& options);

  const CompressionProblem& problem() const { return problem_; }
  const CompressionOptions& options() const { return options_; }
  const Model& model() const { return *breast_.model; }
  const PlateFrame& frame() const { return frame_; }
  const PlacedPlates& placed() const { return placed_; }
  const PressedBreast& breast() const { return breast_; }
  PressedBreast& breast() { return breast_; }
  const Newton& newton() const { return newton_; }
  Newton& newton() { return newton_; }
  double penalty() const { return breast_.contact->penalty; }  ///< [kPa/mm]
  void set_penalty(double penalty) { breast_.contact->penalty = penalty; }

  void put(const PlacedPlates& placed);
  void move_paddle(double height, double tilt);  ///< up · x [mm], [deg]
  /// Its shape when the plates come: the mesh's own, or the imaged one where it is pulled.
  const std::vector<HermiteMesh::Node>& positioned() const { return positioned_.mesh.nodes(); }
  void take_plates_away() { breast_.contact->plates.clear(); }

  double thickness(const State& state) const { return frame_.extent(state.x); }  ///< [mm]
  ContactFigures figures(const State& state, PlateNumber plate) const;
  double penetration(const State& state) const;   ///< largest, of both plates [mm]
  double mean_gap(const State& state) const;      ///< likewise
  double paddle_force(const State& state) const;  ///< [N]

  /// By how much the spring would have the paddle tilt further [deg]; 0 for a rigid one.
  double tilt_error(const State& state) const;

  /// Equilibrium with the plates where they are, to the tolerance of load steps: at a soft penalty
  /// first, then at stiffer ones until no point is more than half a millimetre inside. `penalty` is
  /// one that was enough nearby [kPa/mm]; 0: none is known. `near`: the state goes with the plates
  /// already, and no softer penalty comes before it.
  NewtonReport squeeze(State& state, double penalty, bool near = false);

  /// Equilibrium near a state that already is one, to what Newton reaches or to a residual of
  /// `tolerance` of the flow.
  NewtonReport resettle(State& state, double tolerance = 0);

  /// Brings friction's pressures up to a state.
  void track_friction(const State& state);

  /// Ends a load step: fixes where points stick, for the next one. Empty without friction.
  PlateFriction::History commit_friction(const State& state);
  void restore_friction(const PlateFriction::History& history);

  /// What friction holds a state by, and a start from there; nothing without friction.
  std::vector<PlateFriction::Hold> holds(const State& state) const;
  void hold_by_friction(const std::vector<PlateFriction::Hold>& holds, const State& state);

 private:
  /// Of a solve to this tolerance; a careful one asks that the loose states of load steps are
  /// stable.
  NewtonOptions newton_to(double tolerance) const;

  const CompressionProblem& problem_;
  const CompressionOptions& options_;
  MeshFile positioned_;
  PressedBreast breast_;
  PlateFrame frame_;
  Newton newton_;
  PlacedPlates placed_;
};

}  // namespace mammotwin
