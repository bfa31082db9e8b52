#pragma once

#include <string>

#include "fitting/fit_breast.h"
#include "fitting/solve/fit_problem.h"

namespace mammotwin {

/// Weights of one part of the fit, what its mesh must be, and when it ends.
struct FitStage {
  std::string name;
  double data_weight = 1;
  double shape_weight = 1;
  double smoothing = 1e-6;
  int max_steps = 8;  ///< that lower the cost
  MeshDemand demand = MeshDemand::none;
  bool until_proved = false;
  double least_gain = 3e-4;  ///< of the cost, of which a part is energy that no fit can lose
};

/// A slab's mesh on its way through the stages.
class StagedFit {
 public:
  StagedFit(const Slab& slab, HermiteMesh start, FitTarget& target, int max_iterations,
            FitReport& report, const FitProgress& progress);

  HermiteMesh mesh() const { return HermiteMesh(nodes_, start_.elements()); }
  bool proved() const;

  /// Back to the start, with no element emphasised.
  void restart();

  /// Ceres' steps until they gain little. Where a mesh that is to stay proved is stuck, elements
  /// about to fold hold it: they get emphasis, and it goes on.
  void run(const FitStage& stage);

  /// Gives more weight to elements that are badly shaped or near folding, but no emphasis beyond
  /// `most`; false if there are none.
  bool emphasise_poor(int most);

 private:
  class Watch;
  ceres::Solver::Options options(const FitStage& stage) const;

  HermiteMesh start_;
  std::vector<HermiteMesh::Node> nodes_;
  FitTarget& target_;
  FitPoint point_;
  FitProblem problem_;
  int iterations_left_;
  double radius_;  ///< of the trust region, for the next call of Ceres
  FitReport& report_;
  const FitProgress& progress_;
};

}  // namespace mammotwin
