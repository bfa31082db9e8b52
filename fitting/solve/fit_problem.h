#pragma once

#include <ceres/ceres.h>

#include "fitting/solve/fit_point.h"

namespace mammotwin {

/// The whole fit as one ceres::Problem: a parameter block of 24 numbers a node, held parameters by
/// SubsetManifold, and the residuals of FitPoint, which an EvaluationCallback makes for all
/// elements at once.
class FitProblem {
 public:
  /// `nodes` are those that `solve` moves; they and `point` outlive the problem.
  FitProblem(FitPoint& point, const std::vector<HermiteMesh::Corners>& elements,
             const HeldParameters& held, std::vector<HermiteMesh::Node>& nodes);

  FitProblem(const FitProblem&) = delete;
  FitProblem& operator=(const FitProblem&) = delete;

  /// On one thread of Ceres and of BLAS, so that it repeats bit for bit.
  ceres::Solver::Summary solve(const ceres::Solver::Options& options);

  /// Powell's dog leg, which keeps its factorisation when a step is refused, on the normal
  /// equations by CHOLMOD; no tolerance ends it.
  static ceres::Solver::Options options();

 private:
  class Prepare : public ceres::EvaluationCallback {
   public:
    Prepare(FitPoint& point, const std::vector<HermiteMesh::Node>& nodes)
        : point_(point), nodes_(nodes) {}
    void PrepareForEvaluation(bool derivatives, bool new_point) override;

   private:
    FitPoint& point_;
    const std::vector<HermiteMesh::Node>& nodes_;
  };

  Prepare prepare_;
  ceres::Problem problem_;
};

}  // namespace mammotwin
