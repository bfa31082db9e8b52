#include "solver/gravity/pose_equilibria.h"

#include <utility>

#include "solver/gravity/hang.h"
#include "solver/gravity/unload.h"
#include "solver/newton/newton.h"

namespace mammotwin {

namespace {

using Nodes = std::vector<HermiteMesh::Node>;

constexpr double kBalance = 1e-10;

Nodes moved(Nodes nodes, double fraction, const Nodes& by) {
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += fraction * by[i];
  return nodes;
}

}  // namespace

PoseEquilibria::PoseEquilibria(const BreastProblem& imaged, const Eigen::Vector3d& pose_gravity)
    : imaged_(imaged) {
  UnloadOptions options;
  options.check = false;
  const UnloadResult free = unload(imaged, options);
  share_ = free.report.gravity_fraction;
  if (!(share_ > 0)) {
    reason_ = free.report.reason;
    return;
  }
  image_force_ = share_ * imaged.density * imaged.gravity;
  pose_force_ = share_ * imaged.density * pose_gravity;
  inverse_ = std::make_unique<InverseEquilibrium>(imaged, SolidOptions{});
  unloaded_ = inverse_->start();
  const LoadSteppingReport off = step_load(
      unloaded_, options.load,
      [&](double fraction, State& trial) {
        return inverse_->solve(trial, fraction * image_force_, options.tolerance,
                               options.max_iterations);
      },
      [](const LoadSteppingReport&, const State&, const NewtonReport&) {});
  if (!off.complete()) {
    reason_ = off.reason;
    return;
  }
  breast_ = make_breast_model(from_unloaded(imaged_, unloaded_.x), SolidOptions{});
  Newton newton(*breast_.model, *breast_.dofs);
  posed_ = breast_.model->rest();
  HangOptions hanging;
  hanging.tolerance = kBalance;
  hanging.load.smallest_step = 1.0 / 16;
  hanging.load.max_iterations = 120;
  const LoadSteppingReport load = raise_body_force(breast_, newton, pose_force_, hanging, posed_);
  assembler_ = std::make_unique<Assembler>(*breast_.model, *breast_.dofs);
  assembler_->linearise(posed_, {});
  factor_ = std::make_unique<Cholesky>(assembler_->pattern(), breast_.dofs->node_of_equation());
  if (!load.complete())
    reason_ = load.reason;
  else if (!factor_->factor(assembler_->matrix()))
    reason_ = "the equilibrium in the other pose is not stable";
}

BreastModel PoseEquilibria::posed_model(const BreastProblem& problem, const Nodes& unloaded) const {
  BreastModel breast = make_breast_model(from_unloaded(problem, unloaded), SolidOptions{});
  breast.model->set_body_force([this](const Eigen::Vector3d&) { return pose_force_; });
  return breast;
}

Eigen::VectorXd PoseEquilibria::residual(const BreastProblem& problem,
                                         const Nodes& unloaded) const {
  const BreastModel breast = posed_model(problem, unloaded);
  Assembler assembler(*breast.model, *breast.dofs);
  assembler.linearise(posed_, {});
  return assembler.right_hand_side();
}

PoseEquilibria::Step PoseEquilibria::step(const BreastProblem& from,
                                          const BreastProblem& to) const {
  const InverseEquilibrium a(from, SolidOptions{}), b(to, SolidOptions{});
  Step step;
  step.unloaded = inverse_->change(unloaded_, image_force_, a, b).x;
  const Eigen::VectorXd change =
      factor_->solve(residual(to, moved(unloaded_.x, 0.5, step.unloaded)) -
                     residual(from, moved(unloaded_.x, -0.5, step.unloaded)));
  step.posed = assembler_->nodal_step(change, {});
  return step;
}

}  // namespace mammotwin
