#pragma once

#include <optional>

#include "solver/gravity/hang.h"
#include "solver/progress.h"

namespace mammotwin {

struct UnloadOptions {
  SolidOptions solid;
  double tolerance = 1e-10;   ///< of both balances, relative: 1e-7 mm in position
  LoadSteppingOptions load;   ///< parts of the gravity
  int max_iterations = 12;    ///< Newton iterations a step: a good step needs 4 to 6
  bool check = true;          ///< loads the result again, and the naive reversal beside it
  double rest_tolerance = 1;  ///< farther off [mm, RMS of the nodes], the breast fell elsewhere
  bool parts = true;          ///< where all of the gravity does not work, the largest that does
};

struct UnloadReport {
  bool converged = false;
  std::string reason;  ///< why not
  /// Largest part of the gravity that could be taken off so that, put on again, the breast rests
  /// about where it was imaged.
  double gravity_fraction = 0;
  /// Of the imaged shape under that part of the gravity: how much of its stiffness against the
  /// softest deformation is left, 1 without load (InverseEquilibrium::stability_margin). 0 where
  /// the imaged shape itself is not stable, but one beside it is.
  double stability_margin = 0;
  int steps = 0, cutbacks = 0, newton_iterations = 0;
  double skin_force_N = 0;                  ///< of what pressed, on each side (PressingSprings)
  double sag_max_mm = 0;                    ///< largest way of a node from unloaded to prone
  double stretch_p95 = 1, stretch_max = 1;  ///< largest principal stretch at quadrature points
  double min_J = 1, max_J = 1;
  /// Of nodes: unloaded, loaded again, against prone; 0 where that was not needed and not checked.
  double round_trip_max_mm = 0, round_trip_rms_mm = 0;
  /// The same for the prone shape solved with gravity reversed; empty where that or its reload does
  /// not converge in 12 iterations.
  std::optional<double> naive_reversal_error_mm;
  int dof = 0;
  bool usable() const { return converged; }

  /// All stiffnesses (tissue, skin, springs) times this would do: only the ratio of gravity to
  /// stiffness counts, and so the shape found is the one of that tissue under all of its weight.
  /// Infinite where no part of the gravity worked.
  double sufficient_stiffness_factor() const { return 1 / gravity_fraction; }
};

struct UnloadResult {
  std::vector<HermiteMesh::Node> unloaded;  ///< at the last good part of the gravity
  std::vector<double> pressure;  ///< of the imaged shape then, 8 an element (State::pressure) [kPa]
  UnloadReport report;
};

/// The shape free of stress that `problem.gravity`, and what pressed `problem.pressed`, turn into
/// `problem.mesh`, which is the breast as imaged (`problem.prone` is not looked at). Free of load
/// the pressed skin lies about as far outward as the problem says (PressingSprings); loaded again
/// by what that takes, it is held where it was imaged.
///
/// Springs are taken to be relaxed, and the skin unstressed, in the unloaded shape; the chest wall
/// stands where the prone one does, and tissue slides on it.
///
/// The imaged shape balances, but it may be no minimum of the energy. Where a shape beside it is,
/// within the rest tolerance, it is that which the breast was imaged in, as well as fit and image
/// show: tissue that a wall bears on an edge rolls off it by millimetres and stays there. Where
/// none is, the largest part of the gravity is sought for which there is one.
/// Throws std::invalid_argument as make_breast_model does.
UnloadResult unload(const BreastProblem& problem, const UnloadOptions& options,
                    const Progress& progress = {});

/// The problem whose mesh is the unloaded shape and which remembers the prone one.
BreastProblem from_unloaded(const BreastProblem& prone,
                            const std::vector<HermiteMesh::Node>& unloaded);

}  // namespace mammotwin
