#pragma once

#include "solver/breast/breast_problem.h"
#include "solver/element/solid_element.h"
#include "solver/load/load_stepping.h"
#include "solver/newton/newton.h"

namespace mammotwin {

struct BreastModel;

struct HangOptions {
  SolidOptions solid;
  double tolerance = 1e-9;  ///< of the balance, relative (NewtonOptions)
  LoadSteppingOptions load;
  int step_iterations = 120;  ///< Newton iterations of one load step, at most
};

/// Of a soft breast into another pose: two of 20 real ones came to rest standing after 161 and 164
/// iterations.
HangOptions to_another_pose();

struct HangReport {
  bool converged = false;
  std::string reason;           ///< why not
  double gravity_fraction = 0;  ///< largest part of the gravity that was balanced
  int steps = 0, newton_iterations = 0;
  double sag_max_mm = 0;  ///< largest way of a node from the mesh
  double min_J = 1, max_J = 1;
  bool usable() const { return converged; }
};

struct HangResult {
  std::vector<HermiteMesh::Node> deformed;  ///< at the last good step
  HangReport report;
};

/// The breast under `problem.gravity` alone; `problem.mesh` is the unloaded shape. Throws
/// std::invalid_argument as make_breast_model does.
HangResult hang(const BreastProblem& problem, const HangOptions& options);

/// Raises a constant body force [mN/mm³] on the model from 0, from the state's shape on.
LoadSteppingReport raise_body_force(BreastModel& breast, Newton& newton,
                                    const Eigen::Vector3d& body_force, const HangOptions& options,
                                    State& state);

/// Distance between nodes of the same number [mm]: the largest, and the root mean square.
double largest_distance(const std::vector<HermiteMesh::Node>& a,
                        const std::vector<HermiteMesh::Node>& b);
double rms_distance(const std::vector<HermiteMesh::Node>& a,
                    const std::vector<HermiteMesh::Node>& b);

}  // namespace mammotwin
