#include "pipeline/validation/lagrange/lagrange_newton.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace mammotwin {

LagrangeNewton::LagrangeNewton(const LagrangeMesh& mesh, const Model& model,
                               const std::vector<bool>& held)
    : mesh_(mesh), model_(model), equation_(held.size(), -1), linear_(mesh.elements.size()) {
  for (std::size_t dof = 0; dof < held.size(); ++dof)
    if (!held[dof]) equation_[dof] = num_equations_++;
  for (const auto& nodes : mesh.elements) {
    auto& equations = element_equations_.emplace_back();
    for (int i = 0; i < 3; ++i)
      for (int n : nodes) equations.push_back(equation_[3 * n + i]);
  }
  matrix_.resize(num_equations_, num_equations_);
}

mammotwin::State LagrangeNewton::hermite(const State& state) const {
  return {mesh_.broken(state.x).nodes(), state.pressure};
}

Eigen::MatrixXd LagrangeNewton::reduce(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd& T = mesh_.element.coefficients_from_nodes();
  const int n = mesh_.element.num_nodes();
  Eigen::MatrixXd reduced(3 * n, columns.cols());
  for (int i = 0; i < 3; ++i)
    reduced.middleRows(n * i, n).noalias() =
        T.transpose() * columns.middleRows(kFunctions * i, kFunctions);
  return reduced;
}

/// Condenses the element's pressures and adds it to the system.
void LagrangeNewton::add(int e, const ElementSystem& system,
                         std::vector<Eigen::Triplet<double>>& entries) {
  const int pressures = model_.element(e).num_pressures();
  Linear& kept = linear_[e];
  kept.compliance = model_.element(e).pressure_compliance();
  kept.coupling = reduce(system.coupling.leftCols(pressures));
  kept.residual = system.pressure_residual.head(pressures);
  const Eigen::MatrixXd full = system.tangent.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd rates = kept.compliance.llt().solve(kept.coupling.transpose());
  const Eigen::MatrixXd tangent = reduce(reduce(full).transpose()) + kept.coupling * rates;
  const Eigen::VectorXd residual = reduce(system.residual) + rates.transpose() * kept.residual;
  const auto& equations = element_equations_[e];
  for (std::size_t c = 0; c < equations.size(); ++c) {
    if (equations[c] < 0) continue;
    right_hand_side_[equations[c]] -= residual[c];
    for (std::size_t r = 0; r < equations.size(); ++r)
      if (equations[r] >= equations[c])
        entries.emplace_back(equations[r], equations[c], tangent(r, c));
  }
}

LagrangeNewton::Balance LagrangeNewton::linearise(const State& state, bool with_tangent) {
  const mammotwin::State fine = hermite(state);
  Balance sum;
  sum.residual = Eigen::VectorXd::Zero(num_equations_);
  if (with_tangent) right_hand_side_ = Eigen::VectorXd::Zero(num_equations_);
  std::vector<Eigen::Triplet<double>> entries;
  ElementSystem system;
  for (int e = 0; e < model_.num_elements(); ++e) {
    model_.evaluate(e, fine, with_tangent ? TangentKind::exact : TangentKind::none, system);
    sum.energy += system.energy;
    if (!std::isfinite(sum.energy)) return sum;
    const Eigen::VectorXd residual = reduce(system.residual);
    sum.squared_flow += residual.squaredNorm();
    for (std::size_t k = 0; k < element_equations_[e].size(); ++k)
      if (const int equation = element_equations_[e][k]; equation >= 0)
        sum.residual[equation] += residual[k];
    if (with_tangent) add(e, system, entries);
  }
  if (with_tangent) matrix_.setFromTriplets(entries.begin(), entries.end());
  return sum;
}

LagrangeNewton::State LagrangeNewton::moved(const State& from, const Eigen::VectorXd& step,
                                            double fraction) const {
  State to = from;
  for (std::size_t dof = 0; dof < equation_.size(); ++dof)
    if (equation_[dof] >= 0) to.x[dof / 3][dof % 3] += fraction * step[equation_[dof]];
  return to;
}

/// One step with a line search along it at the new pressures, as in newton.cpp.
bool LagrangeNewton::advance(State& state, const Balance& before) {
  constexpr double overshoot = 0.9, cut = 0.4;
  constexpr int max_cuts = 12;
  const Eigen::VectorXd step = cholesky_.solve(right_hand_side_);
  for (std::size_t e = 0; e < linear_.size(); ++e) {
    Eigen::VectorXd own(element_equations_[e].size());
    for (int k = 0; k < own.size(); ++k)
      own[k] = element_equations_[e][k] < 0 ? 0 : step[element_equations_[e][k]];
    const Linear& l = linear_[e];
    const Eigen::VectorXd increment =
        l.compliance.llt().solve(l.coupling.transpose() * own + l.residual);
    for (int m = 0; m < increment.size(); ++m) state.pressure[8 * e + m] += increment[m];
  }
  const double slope = linearise(state, false).residual.dot(step);
  double fraction = 1;
  for (int k = 0; k < max_cuts; ++k, fraction *= cut) {
    const State trial = moved(state, step, fraction);
    const Balance balance = linearise(trial, false);
    if (!std::isfinite(balance.energy)) continue;
    if (balance.residual.dot(step) <= overshoot * std::abs(slope) ||
        balance.residual.norm() < before.residual.norm()) {
      state = trial;
      return true;
    }
  }
  return false;
}

NewtonReport LagrangeNewton::solve(State& state, int max_iterations, double tolerance) {
  NewtonReport report;
  for (; report.iterations < max_iterations; ++report.iterations) {
    const Balance balance = linearise(state, true);
    report.residual = balance.residual.norm() / std::sqrt(balance.squared_flow);
    double constraint = 0;
    for (std::size_t e = 0; e < linear_.size(); ++e)
      constraint = std::max(constraint, linear_[e].residual.cwiseAbs().maxCoeff() /
                                            model_.element(static_cast<int>(e)).volume());
    report.converged = report.residual <= tolerance && constraint <= std::max(tolerance, 1e-6);
    if (report.converged) return report;
    if (!analysed_) cholesky_.analyzePattern(matrix_);
    analysed_ = true;
    cholesky_.factorize(matrix_);
    if (cholesky_.info() != Eigen::Success) {
      report.reason = "the tangent is indefinite";
      return report;
    }
    if (!advance(state, balance)) {
      report.reason = "the line search found no valid step";
      return report;
    }
  }
  report.reason = "no equilibrium within the allowed iterations";
  return report;
}

}  // namespace mammotwin
