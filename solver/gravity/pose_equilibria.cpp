#include "solver/gravity/pose_equilibria.h"

#include <utility>

#include "solver/gravity/hang.h"
#include "solver/gravity/unload.h"
#include "solver/newton/newton.h"

namespace mammotwin {

namespace {

using Nodes = std::vector<HermiteMesh::Node>;

}  // namespace

PoseEquilibria::PoseEquilibria(const BreastProblem& imaged, const Eigen::Vector3d& pose_gravity)
    : imaged_(imaged) {
  UnloadOptions options;
  options.check = false;
  UnloadResult free = unload(imaged, options);
  share_ = free.report.gravity_fraction;
  if (!(share_ > 0)) {
    reason_ = free.report.reason;
    return;
  }
  image_force_ = share_ * imaged.density * imaged.gravity;
  pose_force_ = share_ * imaged.density * pose_gravity;
  unloaded_ = {std::move(free.unloaded), std::move(free.pressure)};
  inverse_ = std::make_unique<InverseEquilibrium>(imaged, SolidOptions{});
  inverse_->linearise_at(unloaded_, image_force_);
  breast_ = make_breast_model(from_unloaded(imaged_, unloaded_.x), SolidOptions{});
  Newton newton(*breast_.model, *breast_.dofs);
  posed_ = breast_.model->rest();
  const LoadSteppingReport load =
      raise_body_force(breast_, newton, pose_force_, to_another_pose(), posed_);
  assembler_ = std::make_unique<Assembler>(*breast_.model, *breast_.dofs);
  assembler_->linearise(posed_, {});
  factor_ = std::make_unique<Cholesky>(assembler_->pattern(), breast_.dofs->node_of_equation());
  if (!load.complete())
    reason_ = load.reason;
  else if (!factor_->factor(assembler_->matrix()))
    reason_ = "the equilibrium in the other pose is not stable";
}

Eigen::VectorXd PoseEquilibria::residual(const BreastProblem& problem,
                                         const Nodes& unloaded) const {
  const BreastModel breast = make_breast_model(from_unloaded(problem, unloaded), SolidOptions{});
  breast.model->set_body_force([this](const Eigen::Vector3d&) { return pose_force_; });
  Assembler assembler(*breast.model, *breast.dofs);
  assembler.linearise(posed_, {});
  return assembler.right_hand_side();
}

PoseEquilibria::Step PoseEquilibria::step(const BreastProblem& from,
                                          const BreastProblem& to) const {
  const InverseEquilibrium a(from, SolidOptions{}), b(to, SolidOptions{});
  Step step;
  step.unloaded = inverse_->change(unloaded_, image_force_, a, b);
  const Eigen::VectorXd change =
      factor_->solve(residual(to, combined(1, unloaded_.x, 0.5, step.unloaded)) -
                     residual(from, combined(1, unloaded_.x, -0.5, step.unloaded)));
  step.posed = assembler_->nodal_step(change, {});
  return step;
}

}  // namespace mammotwin
