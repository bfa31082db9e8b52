#pragma once

#include "solver/gravity/unload.h"

namespace mammotwin {

/// Distance [mm] of a deformed breast from what was seen of it.
using StateDistance = std::function<double(const std::vector<HermiteMesh::Node>& deformed)>;

struct StiffnessFit {
  double factor = 1;
  double distance_mm = 0;  ///< at that factor
  double distance_at_one_mm =
      0;  ///< with the stiffnesses as given; infinite if it did not converge
  int trials = 0;
  std::string reason;  ///< why no factor was found; empty otherwise
  bool usable() const { return reason.empty(); }
};

/// One factor on all stiffnesses, from a second state of the same breast: unloaded with each trial
/// factor and loaded again by `second_gravity`, it shall come nearest to that state. Golden section
/// on the factor's logarithm from 0.1 to 10, to 2 %; a factor that does not converge is too low.
/// Only gravity over stiffness counts, so gravity is divided and the tissue left as it is.
StiffnessFit fit_stiffness(const BreastProblem& prone, const Eigen::Vector3d& second_gravity,
                           const StateDistance& distance, const UnloadOptions& options,
                           const Progress& progress = {});

}  // namespace mammotwin
