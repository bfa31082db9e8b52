#pragma once

#include <memory>
#include <vector>

#include "solver/breast/breast_model.h"
#include "solver/gravity/general_matrix.h"
#include "solver/gravity/pressing_springs.h"
#include "solver/load/load_stepping.h"

namespace mammotwin {

/// Equilibrium written on the known deformed shape x: which reference shape X makes
///
///     residual(x; X, p) = 0,   ∫ ψ (J − 1 − p/κ) dV = 0
///
/// where the residuals are those of the forward problem, bit for bit, and so a solution meets them
/// whatever the mesh (inverse finite deformation: Govindjee and Mihalic, Comput. Methods Appl.
/// Mech. Engrg. 136 (1996) 47-57, there for the continuum). Newton on (X, p) with the exact
/// tangent, which is not symmetric.
class InverseEquilibrium {
 public:
  /// problem.mesh is the deformed shape; problem.prone is not looked at. Throws as
  /// make_breast_model does.
  InverseEquilibrium(const BreastProblem& problem, const SolidOptions& solid);

  /// The deformed shape as its own reference, without pressure: the solution without a load.
  State start() const;

  /// How far problem.pressed goes outward [mm]; 0 at first.
  void set_skin_way(double way_mm) { skin_way_mm_ = way_mm; }

  /// What pressed there, of a solution.
  DeadForces skin_forces(const State& solution) const;
  double skin_force_N(const State& solution) const;

  int num_equations() const { return pattern_.num_columns(); }

  /// Brings `reference` (its x is X) to equilibrium under a constant body force [mN/mm³]. On
  /// failure it is the last iterate.
  NewtonReport solve(State& reference, const Eigen::Vector3d& body_force, double tolerance,
                     int max_iterations);

  /// The same from `start()` on, body force and the pressed skin's way raised together, in steps of
  /// at most `max_iterations` each.
  LoadSteppingReport raise(State& reference, const Eigen::Vector3d& body_force, double way_mm,
                           const LoadSteppingOptions& load, double tolerance, int max_iterations,
                           const StepDone& step_done);

  /// Factors the tangent at a solution, for `change`. Throws std::runtime_error where it is
  /// singular.
  void linearise_at(const State& solution, const Eigen::Vector3d& body_force);

  /// What that solution's shape free of load changes by between two problems that are next to this
  /// one, to first order: -(∂R/∂X)⁻¹ (R_to - R_from), pressures eliminated.
  std::vector<HermiteMesh::Node> change(const State& solution, const Eigen::Vector3d& body_force,
                                        const InverseEquilibrium& from,
                                        const InverseEquilibrium& to) const;

  /// Of the linearised solution: what its shape free of load changes by for each mm that the
  /// pressed skin goes farther outward, to first order.
  std::vector<HermiteMesh::Node> change_by_skin_way(const State& solution) const;

  /// Of a solution: the smallest eigenvalue of the forward problem's tangent in the deformed shape
  /// against that in the shape free of load (in the metric of the μ-weighted Laplacian; 1 without
  /// load), or 0 where it is not positive definite: the deformed shape then is no minimum of the
  /// energy, and the reference, loaded, falls elsewhere.
  double stability_margin(const State& reference) const;

 private:
  struct Evaluation {
    bool valid = false;                 ///< neither X nor x is folded
    BreastModel breast;                 ///< of which X is the reference
    Eigen::VectorXd residual;           ///< per equation [mN]
    Eigen::MatrixXd pressure_residual;  ///< 8 x elements [mm³]
    double flow = 0;  ///< √Σ|element residual|², at least that of a small strain [mN]
    double largest_volume_error = 0;  ///< relative to the element's volume
  };
  struct Elimination {  ///< of one element's pressures
    Eigen::MatrixXd coupling, pressure_tangent, stiffness;
  };
  struct Step {
    std::vector<HermiteMesh::Node> nodes;
    std::vector<double> pressure;
  };
  BreastModel forward_model(const State& reference) const;
  Evaluation evaluate(const State& reference, const Eigen::Vector3d& body_force) const;
  bool folded(const std::vector<HermiteMesh::Node>& X) const;
  bool linearise(const State& reference, const Evaluation& here, const Eigen::Vector3d& body_force);
  Eigen::VectorXd correction(const Evaluation& here) const;
  Step step_of(const Eigen::VectorXd& correction, const Evaluation& here) const;
  bool search(State& reference, Evaluation& here, const Eigen::Vector3d& body_force) const;

  BreastProblem problem_;  ///< its tissue is remembered: every reference has the same
  SolidOptions solid_;
  double skin_way_mm_ = 0;
  BreastModel prone_;
  PressingSprings springs_;
  SparsePattern pattern_;
  std::unique_ptr<GeneralMatrix> matrix_;
  std::vector<Elimination> eliminations_;
};

}  // namespace mammotwin
