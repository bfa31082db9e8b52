#include "solver/newton/assembler.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/element/tensor_kernels.h"

namespace mammotwin {

namespace {

constexpr double kSmallStrain = 1e-3;  // below it balance is absolute: rest has no flow

using Residual = Eigen::Matrix<double, kUnknowns, 1>;

/// 0.3 MB: one for each thread, not one for each call.
ElementSystem& workspace() {
  static thread_local ElementSystem system;
  return system;
}

Eigen::MatrixXd inverse_factor(const Eigen::MatrixXd& M) {
  const int n = static_cast<int>(M.rows());
  return M.llt().matrixL().solve(Eigen::MatrixXd::Identity(n, n));
}

Balance part_of(const ElementSystem& system, double volume) {
  Balance part;
  part.energy = system.energy;
  part.min_J = system.min_J;
  part.max_J = system.max_J;
  part.deformed_volume = system.deformed_volume;
  part.flow = system.squared_flow;
  part.constraint = system.pressure_residual.cwiseAbs().maxCoeff() / volume;
  return part;
}

}  // namespace

Assembler::Assembler(const Model& model, const DofMap& dofs)
    : model_(model), pattern_(make_sparse_pattern(model.reference(), dofs)) {
  for (int e = 0; e < model.num_elements(); ++e)
    pressure_factors_.push_back(inverse_factor(model.element(e).pressure_compliance()));
  eliminations_.resize(model.num_elements());
  for (int e = 0; e < model.num_elements(); ++e)
    smallest_flow_ += std::pow(kSmallStrain * model.element(e).material(0).shear_modulus() *
                                   std::pow(model.element(e).volume(), 2.0 / 3),
                               2);
  smallest_flow_ = std::sqrt(smallest_flow_);
  values_.resize(pattern_.rows.size());
}

Balance Assembler::summarise(const std::vector<Balance>& parts) const {
  Balance sum;
  sum.min_J = std::numeric_limits<double>::infinity();
  sum.max_J = -sum.min_J;
  for (const Balance& part : parts) {
    sum.energy += part.energy;
    sum.deformed_volume += part.deformed_volume;
    sum.flow += part.flow;
    sum.min_J = std::min(sum.min_J, part.min_J);
    sum.max_J = std::max(sum.max_J, part.max_J);
    sum.constraint = std::max(sum.constraint, part.constraint);
  }
  sum.flow = std::hypot(std::sqrt(sum.flow), smallest_flow_);
  return sum;
}

Balance Assembler::balance(const State& state) const {
  const int count = model_.num_elements();
  std::vector<Balance> parts(count);
  std::vector<Residual> residuals(count);
  tbb::parallel_for(0, count, [&](int e) {
    ElementSystem& system = workspace();
    model_.evaluate(e, state, false, system);
    parts[e] = part_of(system, model_.element(e).volume());
    residuals[e] = system.residual;
  });
  Balance sum = summarise(parts);
  sum.residual = Eigen::VectorXd::Zero(num_equations());
  if (!std::isfinite(sum.energy)) return sum;
  for (int e = 0; e < count; ++e)
    for (int k = 0; k < kUnknowns; ++k)
      if (const int equation = pattern_.equations[e][k]; equation >= 0)
        sum.residual[equation] += pattern_.factors[e][k] * residuals[e][k];
  return sum;
}

Balance Assembler::linearise(const State& state, double shift,
                             const std::vector<HermiteMesh::Node>& pending) {
  const int count = model_.num_elements();
  if (shift > 0 && laplacians_.empty())
    for (int e = 0; e < count; ++e) laplacians_.push_back(model_.element(e).laplacian());
  std::fill(values_.begin(), values_.end(), 0.0);
  right_hand_side_ = Eigen::VectorXd::Zero(num_equations());
  std::vector<Balance> parts(count);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(num_equations());
  for (const auto& colour : pattern_.colours)
    tbb::parallel_for(std::size_t{0}, colour.size(), [&](std::size_t k) {
      const int e = colour[k];
      ElementSystem& system = workspace();
      model_.evaluate(e, state, true, system);
      parts[e] = part_of(system, model_.element(e).volume());
      if (!std::isfinite(system.energy)) return;
      for (int r = 0; r < kUnknowns; ++r)
        if (const int equation = pattern_.equations[e][r]; equation >= 0)
          residual[equation] += pattern_.factors[e][r] * system.residual[r];
      if (shift > 0)
        for (int i = 0; i < 3; ++i)
          system.tangent.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * i) +=
              shift * laplacians_[e];
      condense(e, pending.empty() ? Residual::Zero() : gather(e, pending), system);
      scatter(e, system);
    });
  Balance sum = summarise(parts);
  sum.residual = std::move(residual);
  return sum;
}

void Assembler::condense(int e, const Residual& pending, ElementSystem& system) {
  const int n = model_.element(e).num_pressures();
  Elimination& kept = eliminations_[e];
  kept.residual = system.pressure_residual;
  // With C = L⁻¹ couplingᵀ: tangent += CᵀC, residual += Cᵀ L⁻¹ (pressure residual).
  kept.coupling.leftCols(n) = system.coupling.leftCols(n) * pressure_factors_[e].transpose();
  add_outer_product(kept.coupling.data(), n, system.tangent.data());
  system.residual += kept.coupling.leftCols(n) * (pressure_factors_[e] * kept.residual.head(n));
  if (!pending.isZero(0))
    system.residual += system.tangent.selfadjointView<Eigen::Lower>() * pending;
}

void Assembler::scatter(int e, const ElementSystem& system) {
  const auto& equations = pattern_.equations[e];
  const auto& factors = pattern_.factors[e];
  const int* position = pattern_.positions[e].data();
  for (int c = 0; c < kUnknowns; ++c) {
    if (equations[c] >= 0) right_hand_side_[equations[c]] -= factors[c] * system.residual[c];
    const double* column = system.tangent.data() + kUnknowns * c;
    for (int r = c; r < kUnknowns; ++r, ++position)
      if (*position >= 0) values_[*position] += factors[r] * factors[c] * column[r];
  }
}

Residual Assembler::gather(int e, const std::vector<HermiteMesh::Node>& x) const {
  const auto c = model_.coefficients(x, e);
  return c.reshaped();
}

std::vector<HermiteMesh::Node> Assembler::nodal_step(
    const Eigen::VectorXd& solution, const std::vector<HermiteMesh::Node>& pending) const {
  const HermiteMesh& mesh = model_.reference();
  std::vector<HermiteMesh::Node> step = pending;
  step.resize(mesh.num_nodes(), HermiteMesh::Node::Zero());
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < kFunctions; ++a) {
        const int k = kFunctions * i + a;
        const int equation = pattern_.equations[e][k];
        if (equation >= 0)
          step[mesh.corners(e)[corner_of_function(a)]](i, parameter_of_function(a)) =
              pattern_.factors[e][k] * solution[equation];
      }
  return step;
}

std::vector<double> Assembler::pressures_after(const State& state,
                                               const std::vector<HermiteMesh::Node>& step,
                                               double& work) const {
  std::vector<double> pressure = state.pressure;
  work = 0;
  for (int e = 0; e < model_.num_elements(); ++e) {
    const int n = model_.element(e).num_pressures();
    const auto& kept = eliminations_[e];
    const Eigen::VectorXd rate = kept.coupling.leftCols(n).transpose() * gather(e, step);
    const Eigen::VectorXd scaled = rate + pressure_factors_[e] * kept.residual.head(n);
    const Eigen::VectorXd increment = pressure_factors_[e].transpose() * scaled;
    work += rate.dot(scaled);
    for (int m = 0; m < n; ++m) pressure[8 * e + m] += increment[m];
  }
  return pressure;
}

std::vector<HermiteMesh::Node> Assembler::nodal_residual(const State& state) const {
  const HermiteMesh& mesh = model_.reference();
  std::vector<HermiteMesh::Node> residual(mesh.num_nodes(), HermiteMesh::Node::Zero());
  ElementSystem& system = workspace();
  for (int e = 0; e < mesh.num_elements(); ++e) {
    model_.evaluate(e, state, false, system);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < kFunctions; ++a)
        residual[mesh.corners(e)[corner_of_function(a)]](i, parameter_of_function(a)) +=
            system.residual[kFunctions * i + a];
  }
  return residual;
}

}  // namespace mammotwin
