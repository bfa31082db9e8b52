#include "solver/gravity/inverse_equilibrium.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "solver/newton/stability.h"

namespace mammotwin {

namespace {

constexpr double kSpringPenalty = 30;  // x modulus/size: what is asked of the skin prevails

using Fractions = std::vector<std::array<double, 3>>;

/// Keeps what the sampler gives in `memory`.
TissueSampler recording(const TissueSampler& tissue, std::shared_ptr<Fractions> memory) {
  return [tissue, memory](const Eigen::Vector3d& x, double volume) {
    memory->push_back(tissue(x, volume));
    return memory->back();
  };
}

/// Gives it again, over and over: every model of one breast asks for the same points in one order.
TissueSampler replaying(std::shared_ptr<const Fractions> memory) {
  return [memory, next = std::size_t{0}](const Eigen::Vector3d&, double) mutable {
    next %= memory->size();
    return (*memory)[next++];
  };
}

/// The imaged shape as its own reference; the problem remembers its tissue.
BreastModel remembered_model(BreastProblem& problem, const SolidOptions& solid) {
  problem.prone.clear();
  problem.gravity.setZero();
  problem.skin_forces.clear();
  auto memory = std::make_shared<Fractions>();
  problem.tissue = recording(problem.tissue, memory);
  BreastModel model = make_breast_model(problem, solid);
  problem.tissue = replaying(memory);
  return model;
}

State moved(const State& from, const std::vector<HermiteMesh::Node>& nodes,
            const std::vector<double>& pressure, double fraction) {
  State to = from;
  for (std::size_t i = 0; i < to.x.size(); ++i) to.x[i] += fraction * nodes[i];
  for (std::size_t i = 0; i < to.pressure.size(); ++i) to.pressure[i] += fraction * pressure[i];
  return to;
}

/// (∫ψψᵀ/κ)⁻¹ of an element.
Eigen::MatrixXd pressure_stiffness(const SolidElement& element) {
  const Eigen::MatrixXd compliance = element.pressure_compliance();
  return compliance.llt().solve(Eigen::MatrixXd::Identity(compliance.rows(), compliance.rows()));
}

NewtonReport& stopped(NewtonReport& report, const char* reason) {
  report.reason = reason;
  return report;
}

}  // namespace

InverseEquilibrium::InverseEquilibrium(const BreastProblem& problem, const SolidOptions& solid)
    : problem_(problem),
      solid_(solid),
      prone_(remembered_model(problem_, solid)),
      springs_(problem_, kSpringPenalty * prone_.penalty_unit()) {
  problem_.prone = problem.mesh.mesh.nodes();
  pattern_ = make_sparse_pattern(problem.mesh.mesh, *prone_.dofs);
  matrix_ = std::make_unique<GeneralMatrix>(pattern_);
}

State InverseEquilibrium::start() const { return prone_.model->rest(); }

DeadForces InverseEquilibrium::skin_forces(const State& solution) const {
  return springs_.any()
             ? springs_.forces(HermiteMesh(solution.x, problem_.mesh.mesh.elements()), skin_way_mm_)
             : DeadForces();
}

double InverseEquilibrium::skin_force_N(const State& solution) const {
  return springs_.any() ? springs_.force_N(HermiteMesh(solution.x, problem_.mesh.mesh.elements()),
                                           skin_way_mm_)
                        : 0;
}

bool InverseEquilibrium::folded(const std::vector<HermiteMesh::Node>& X) const {
  for (int e = 0; e < prone_.model->num_elements(); ++e)
    for (const auto& F :
         prone_.model->element(e).deformation_gradients(prone_.model->coefficients(X, e)))
      if (!(F.determinant() > 0)) return true;
  return false;
}

BreastModel InverseEquilibrium::forward_model(const State& reference) const {
  BreastProblem problem = problem_;
  problem.mesh.mesh = HermiteMesh(reference.x, problem_.mesh.mesh.elements());
  return make_breast_model(problem, solid_);
}

double InverseEquilibrium::stability_margin(const State& reference) const {
  const BreastModel breast = forward_model(reference);
  Assembler assembler(*breast.model, *breast.dofs);
  Cholesky factor(assembler.pattern(), breast.dofs->node_of_equation());
  const auto softest = [&](const State& state) {
    assembler.linearise(state, {});
    return factor.factor(assembler.matrix())
               ? smallest_stiffness(factor, assembler.pattern(), assembler.metric())
               : 0;
  };
  const double free_of_load = softest(breast.model->rest());
  return softest({problem_.prone, reference.pressure}) / free_of_load;
}

InverseEquilibrium::Evaluation InverseEquilibrium::evaluate(
    const State& reference, const Eigen::Vector3d& body_force) const {
  Evaluation now;
  if (folded(reference.x)) return now;
  now.breast = forward_model(reference);
  const Model& model = *now.breast.model;
  now.breast.model->set_body_force([&](const Eigen::Vector3d&) { return body_force; });
  const State state{problem_.prone, reference.pressure};
  const int count = model.num_elements();
  std::vector<ElementSystem> systems(count);
  tbb::parallel_for(0, count, [&](int e) {
    systems[e].tangent.resize(0, 0);
    model.evaluate(e, state, TangentKind::none, systems[e]);
    if (springs_.any())
      springs_.add(e, model.coefficients(reference.x, e), skin_way_mm_, &systems[e], nullptr);
  });
  now.valid = true;
  now.residual = Eigen::VectorXd::Zero(pattern_.num_columns());
  now.pressure_residual.resize(8, count);
  for (int e = 0; e < count; ++e) {
    const ElementSystem& system = systems[e];
    now.valid = now.valid && std::isfinite(system.energy);
    pattern_.add(e, system.residual, 1, now.residual);
    now.pressure_residual.col(e) = system.pressure_residual;
    now.flow += system.squared_flow;
    now.largest_volume_error =
        std::max(now.largest_volume_error,
                 system.pressure_residual.cwiseAbs().maxCoeff() / model.element(e).volume());
  }
  // Below a strain of 1e-3 balance is absolute, as in the forward problem: rest has no flow.
  constexpr double small_strain = 1e-3;
  const double size = now.breast.element_size;
  now.flow = std::sqrt(
      now.flow + count * std::pow(small_strain * now.breast.largest_modulus * size * size, 2));
  return now;
}

bool InverseEquilibrium::linearise(const State& reference, const Evaluation& here,
                                   const Eigen::Vector3d& body_force) {
  const Model& model = *here.breast.model;
  const int count = model.num_elements(), n = model.element(0).num_pressures();
  const State state{problem_.prone, reference.pressure};
  eliminations_.resize(count);
  std::vector<ReferenceSystem> systems(count);
  tbb::parallel_for(0, count, [&](int e) {
    ReferenceSystem& s = systems[e];
    model.evaluate_reference(e, state, body_force, s);
    if (springs_.any())
      springs_.add(e, model.coefficients(reference.x, e), skin_way_mm_, nullptr, &s);
    const Eigen::MatrixXd stiffness = pressure_stiffness(model.element(e));
    s.tangent.noalias() += s.coupling.leftCols(n) * (stiffness * s.pressure_tangent.topRows(n));
    eliminations_[e] = {s.coupling.leftCols(n), s.pressure_tangent.topRows(n), stiffness};
  });
  matrix_->clear();
  for (int e = 0; e < count; ++e) matrix_->add(e, systems[e].tangent);
  return matrix_->factor();
}

Eigen::VectorXd InverseEquilibrium::correction(const Evaluation& here) const {
  Eigen::VectorXd right_hand_side = -here.residual;
  for (int e = 0; e < static_cast<int>(eliminations_.size()); ++e) {
    const auto& [coupling, pressure_tangent, stiffness] = eliminations_[e];
    const Eigen::VectorXd pushed =
        coupling * (stiffness * here.pressure_residual.col(e).head(stiffness.rows()));
    pattern_.add(e, pushed, -1, right_hand_side);
  }
  return matrix_->solve(right_hand_side);
}

InverseEquilibrium::Step InverseEquilibrium::step_of(const Eigen::VectorXd& correction,
                                                     const Evaluation& here) const {
  const Model& model = *prone_.model;
  Step step{
      std::vector<HermiteMesh::Node>(model.reference().num_nodes(), HermiteMesh::Node::Zero()),
      std::vector<double>(8 * model.num_elements(), 0.0)};
  for (std::size_t node = 0; node < step.nodes.size(); ++node)
    for (int k = 0; k < 24; ++k)
      if (const int dof = 24 * static_cast<int>(node) + k; !prone_.dofs->prescribed(dof))
        step.nodes[node](k) = prone_.dofs->factor(dof) * correction[prone_.dofs->equation(dof)];
  for (std::size_t e = 0; e < eliminations_.size(); ++e) {
    const auto& [coupling, pressure_tangent, stiffness] = eliminations_[e];
    const Eigen::Matrix<double, kUnknowns, 1> dX = model.coefficients(step.nodes, e).reshaped();
    Eigen::Map<Eigen::VectorXd>(step.pressure.data() + 8 * e, stiffness.rows()) =
        stiffness * (here.pressure_residual.col(e).head(stiffness.rows()) + pressure_tangent * dX);
  }
  return step;
}

LoadSteppingReport InverseEquilibrium::raise(State& reference, const Eigen::Vector3d& body_force,
                                             double way_mm, const LoadSteppingOptions& load,
                                             double tolerance, int max_iterations,
                                             const StepDone& step_done) {
  return step_load(
      reference, load,
      [&](double fraction, State& trial) {
        set_skin_way(fraction * way_mm);
        return solve(trial, fraction * body_force, tolerance, max_iterations);
      },
      step_done);
}

void InverseEquilibrium::linearise_at(const State& solution, const Eigen::Vector3d& body_force) {
  if (!linearise(solution, evaluate(solution, body_force), body_force))
    throw std::runtime_error("the tangent of the inverse problem is singular");
}

std::vector<HermiteMesh::Node> InverseEquilibrium::change(const State& solution,
                                                          const Eigen::Vector3d& body_force,
                                                          const InverseEquilibrium& from,
                                                          const InverseEquilibrium& to) const {
  const Evaluation before = from.evaluate(solution, body_force);
  Evaluation difference = to.evaluate(solution, body_force);
  difference.residual -= before.residual;
  difference.pressure_residual -= before.pressure_residual;
  return step_of(correction(difference), difference).nodes;
}

std::vector<HermiteMesh::Node> InverseEquilibrium::change_by_skin_way(const State& solution) const {
  const HermiteMesh X(solution.x, problem_.mesh.mesh.elements());
  const DeadForces with = springs_.forces(X, 1), without = springs_.forces(X, 0);
  Evaluation difference;
  difference.residual = Eigen::VectorXd::Zero(pattern_.num_columns());
  difference.pressure_residual = Eigen::MatrixXd::Zero(8, X.num_elements());
  for (int e = 0; e < X.num_elements(); ++e)
    pattern_.add(e, (without[e] - with[e]).reshaped(), 1, difference.residual);
  return step_of(correction(difference), difference).nodes;
}

/// Residuals say little here (the wall's penalty swamps them), so the test is natural: the next
/// correction with the same matrix must be smaller (Deuflhard, Newton Methods, section 3.3).
bool InverseEquilibrium::search(State& reference, Evaluation& here,
                                const Eigen::Vector3d& body_force) const {
  constexpr int most_cuts = 6;
  const Eigen::VectorXd full = correction(here);
  const Step step = step_of(full, here);
  double fraction = 1;
  for (int cut = 0; cut < most_cuts; ++cut, fraction /= 2) {
    State trial = moved(reference, step.nodes, step.pressure, fraction);
    Evaluation there = evaluate(trial, body_force);
    if (!there.valid || !(correction(there).norm() <= (1 - fraction / 4) * full.norm())) continue;
    reference = std::move(trial);
    here = std::move(there);
    return true;
  }
  return false;
}

NewtonReport InverseEquilibrium::solve(State& reference, const Eigen::Vector3d& body_force,
                                       double tolerance, int max_iterations) {
  NewtonReport report;
  Evaluation here = evaluate(reference, body_force);
  if (!here.valid) return stopped(report, "an element is inverted");
  for (; report.iterations <= max_iterations; ++report.iterations) {
    report.residual = here.residual.norm() / here.flow;
    if (report.residual <= tolerance && here.largest_volume_error <= tolerance) {
      report.converged = true;
      return report;
    }
    if (report.iterations == max_iterations) break;
    if (!linearise(reference, here, body_force))
      return stopped(report, "the tangent of the inverse problem is singular");
    if (!search(reference, here, body_force))
      return stopped(report, "no step brings the inverse problem nearer to balance");
  }
  return stopped(report, "no unloaded shape within the allowed iterations");
}

}  // namespace mammotwin
