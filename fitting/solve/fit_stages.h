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
  bool steep = false;         ///< the shape energy is; no element gets emphasis on the way then
  bool gauss_newton = false;  ///< the shape energy's Hessian is: it leads out of folds
  double smoothing = 1e-6;
  double tether = 0;  ///< to the mesh that the stage starts from
  int max_steps = 8;  ///< that lower the cost
  MeshDemand demand = MeshDemand::none;
  bool until_proved = false;
  double least_gain = 3e-4;   ///< of the cost, of which a part is energy that no fit can lose
  double last_radius = 0.02;  ///< of the trust region: a smaller one holds no step that counts
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
  void forget_emphasis() { point_.model().shape_energy().forget_emphasis(); }

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
