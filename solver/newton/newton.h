#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/newton/assembler.h"
#include "solver/newton/cholesky.h"
#include "solver/newton/condensed_energy.h"
#include "solver/newton/following.h"

namespace mammotwin {

struct NewtonOptions {
  int max_iterations = 120;
  double tolerance = 1e-7;             ///< |residual| <= tolerance * flow
  double constraint_tolerance = 1e-6;  ///< largest relative volume error left by the pressures
  /// Where the iterations stall (a bifurcation, contact that chatters), a residual and a volume
  /// error of at most this still count as equilibrium; NewtonReport::residual says what is left.
  double acceptable = 1e-4;
  /// Each step's merit is the energy of its start; the step itself knows that what is followed will
  /// move (SurfacePotential::circulation).
  Following following;
  /// Solves of a tolerance up to this leave an unstable state downhill, at most so many times.
  double stable_below = 1e-4;
  int most_falls = 5;
  double max_shift = 1000;  ///< Laplacian shifts tried on an indefinite matrix before giving up [-]
  /// Takes a balanced state whose tangent is indefinite for an answer: for paths that only symmetry
  /// holds, such as a closed form's.
  bool keep_unstable = false;
  /// Called after each step with the merit before and after it (condensed_energy.h) [mN mm].
  std::function<void(double before, double after)> watch;
};

/// The same, content with a residual and a volume error of `tolerance` where they asked for less.
NewtonOptions loosened(NewtonOptions options, double tolerance);

struct NewtonReport {
  bool converged = false;
  int iterations = 0;  ///< linear systems solved
  int factorisations = 0;
  int indefinite = 0;   ///< matrices met that were not positive definite
  double residual = 1;  ///< relative to flow, at the last matrix [-]
  std::string reason;   ///< why not, in a sentence
  bool usable() const { return converged; }
};

/// Newton's method on the mixed system: pressures are unknowns of the linearisation. The step in
/// the shape is then one down the condensed energy, which every accepted step lowers (Armijo), at
/// full length or, where the volume errs, bent back to the volume that it was to have (second-order
/// correction, Nocedal and Wright, section 18.3), else cut, or doubled where the energy curves
/// down. With friction, which has no energy, a step is also taken that lowers the norm of the
/// residual; where many come no nearer to balance, or lead back to an unstable state that was left,
/// pressures of friction are held until the rest is in balance and then follow by a half, and where
/// that comes no nearer either, a solve ends in its nearest state. Far from balance, and where the
/// matrix is not positive definite, it is that of the energy's convex parts (convex_part.h), and
/// shifted by the μ-weighted Laplacian where steps stay short.
class Newton {
 public:
  Newton(const Model& model, const DofMap& dofs);

  /// Brings `state` to equilibrium; `pending` are the increments of prescribed dofs (empty: none)
  /// that the first steps make. On failure the state is the last iterate.
  NewtonReport solve(State& state, const NewtonOptions& options,
                     std::vector<HermiteMesh::Node> pending = {});

  /// Is the condensed tangent positive definite: is a balanced state a minimum of the energy?
  bool is_stable(const State& state);

  Balance balance(const State& state) const { return assembler_.balance(state); }
  const Assembler& assembler() const { return assembler_; }
  const Cholesky& cholesky() const { return cholesky_; }

 private:
  NewtonReport iterate(State& state, const NewtonOptions& options,
                       std::vector<HermiteMesh::Node> pending);
  struct Step {
    std::vector<HermiteMesh::Node> nodes;
    PressureStep pressures;
    double slope = 0;  ///< of the merit along the step; 0 while dofs are still moved
  };
  struct Trial {
    State state;
    Balance balance;
    double merit = 0;
  };
  bool factor(double shift, NewtonReport& report);
  bool factor_definite(const State& state, const NewtonOptions& options,
                       const std::vector<HermiteMesh::Node>& pending, NewtonReport& report);
  bool refresh(const State& state, Balance& balance, const NewtonOptions& options);
  bool fall(State& state, Balance& balance, const NewtonOptions& options, NewtonReport& report);
  Eigen::VectorXd softest_direction();
  Eigen::VectorXd circulated(const Eigen::VectorXd& right_hand_side) const;
  Step step_of(const Eigen::VectorXd& solution, const State& state, const Balance& balance,
               const std::vector<HermiteMesh::Node>& pending);
  Step solve_step(const State& state, const Balance& balance,
                  const std::vector<HermiteMesh::Node>& pending);
  void adapt_damping(double fraction);
  Trial at(const State& state, const Step& step, double fraction) const;
  Trial corrected(const Trial& trial, const Step& step, const Balance& before,
                  double fraction) const;
  Trial tried(const State& state, const Step& step, const Balance& before, double fraction,
              const std::function<bool(const Trial&)>& good) const;
  bool settles(const Trial& trial, const State& state, const Balance& before, double least,
               const NewtonOptions& options) const;
  double lengthened(Trial& trial, const State& state, const Step& step,
                    const Balance& before) const;
  double search(State& state, const Step& step, Balance& balance, const NewtonOptions& options);

  Assembler assembler_;
  Cholesky cholesky_;
  CondensedEnergy merit_;
  double shift_ = 0;
  double damping_ = 0;      ///< shift that short steps ask for
  bool indefinite_ = true;  ///< the last matrix was not the exact one, or there was none
  int indefinite_for_ = 0;  ///< so many iterations near balance
  bool following_ = false;  ///< what is followed is refreshed before each step
  bool held_ = false;       ///< or, after steps that circled, in balance only
};

}  // namespace mammotwin
