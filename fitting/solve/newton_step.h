#pragma once

#include <functional>
#include <memory>

#include "fitting/solve/fit_model.h"

namespace mammotwin {

/// What one step did.
struct StepReport {
  double length = 0;  ///< fraction of the full Newton step that was taken; 0: none
  double cost_before = 0, cost_after = 0;
};

/// Newton's method with a line search for FitModel: the factorisation's pattern is kept, a trial
/// length costs one evaluation, and lengths whose mesh is not acceptable can be refused.
class NewtonStep {
 public:
  /// Parameters that are held keep their values.
  NewtonStep(const std::vector<HermiteMesh::Corners>& elements, const HeldParameters& held);
  ~NewtonStep();

  using Acceptable = std::function<bool(const HermiteMesh&)>;

  /// `nodes` change in place. Halves the step until the cost falls (Armijo, 1e-4) and the mesh is
  /// acceptable, if that is asked.
  StepReport step(const FitModel& model, std::vector<HermiteMesh::Node>& nodes,
                  const Acceptable& acceptable = {});

 private:
  struct System;
  std::unique_ptr<System> system_;
};

}  // namespace mammotwin
