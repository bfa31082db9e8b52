#include "solver/newton/assembler.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
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

double smallest_modulus(const Model& model) {
  double mu = std::numeric_limits<double>::infinity();
  for (int e = 0; e < model.num_elements(); ++e)
    for (int q = 0; q < kPoints; ++q)
      mu = std::min(mu, model.element(e).material(q).shear_modulus());
  return mu;
}

/// √Σ V^(4/3) [mm²]: the elements' faces, added up as their forces are in a flow.
double combined_face_area(const Model& model) {
  double squares = 0;
  for (int e = 0; e < model.num_elements(); ++e)
    squares += std::pow(model.element(e).volume(), 4.0 / 3);
  return std::sqrt(squares);
}

Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& L) {
  const auto n = L.rows();
  return L.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(n, n));
}

}  // namespace

Assembler::Assembler(const Model& model, const DofMap& dofs)
    : model_(model), pattern_(make_sparse_pattern(model.reference(), dofs)) {
  for (int e = 0; e < model.num_elements(); ++e) {
    const Eigen::MatrixXd L = model.element(e).pressure_compliance().llt().matrixL();
    pressure_scales_.push_back(L.transpose());
    pressure_factors_.push_back(inverse_of_lower(L));
  }
  eliminations_.resize(model.num_elements());
  smallest_flow_ = kSmallStrain * smallest_modulus(model) * combined_face_area(model);
  values_.resize(pattern_.rows.size());
}

/// What an element adds to the balance. With r = ∫ψ (J − 1 − p/κ): s = L⁻¹ r + Lᵀp, and the
/// pressures' terms of the energy are p·r + |Lᵀp|²/2.
Balance Assembler::part_of(int e, const State& state, const ElementSystem& system) const {
  Balance part;
  part.energy = system.energy;
  part.min_J = system.min_J;
  part.max_J = system.max_J;
  part.deformed_volume = system.deformed_volume;
  part.flow = system.squared_flow;
  part.constraint = system.pressure_residual.cwiseAbs().maxCoeff() / model_.element(e).volume();
  if (!std::isfinite(system.energy)) return part;
  const int n = model_.element(e).num_pressures();
  const auto p = pressures_of(state, e);
  const auto r = system.pressure_residual.head(n);
  const Eigen::VectorXd scaled = pressure_scales_[e] * p;
  part.swelling = Eigen::VectorXd::Zero(8);
  part.swelling.topRows(n) = pressure_factors_[e] * r + scaled;
  part.stored = system.energy - p.dot(r) - scaled.squaredNorm() / 2;
  return part;
}

Balance Assembler::summarise(const std::vector<Balance>& parts) const {
  Balance sum;
  sum.min_J = std::numeric_limits<double>::infinity();
  sum.max_J = -sum.min_J;
  sum.swelling = Eigen::MatrixXd::Zero(8, parts.size());
  for (std::size_t e = 0; e < parts.size(); ++e) {
    const Balance& part = parts[e];
    sum.energy += part.energy;
    sum.stored += part.stored;
    sum.magnitude += std::abs(part.stored) + part.swelling.squaredNorm() / 2;
    sum.deformed_volume += part.deformed_volume;
    sum.flow += part.flow;
    sum.min_J = std::min(sum.min_J, part.min_J);
    sum.max_J = std::max(sum.max_J, part.max_J);
    sum.constraint = std::max(sum.constraint, part.constraint);
    if (part.swelling.size() > 0) sum.swelling.col(e) = part.swelling;
  }
  sum.flow = std::hypot(std::sqrt(sum.flow), smallest_flow_);
  return sum;
}

Eigen::Map<const Eigen::VectorXd> Assembler::pressures_of(const State& state, int e) const {
  return {state.pressure.data() + 8 * e, model_.element(e).num_pressures()};
}

Balance Assembler::balance(const State& state) const {
  const int count = model_.num_elements();
  std::vector<Balance> parts(count);
  std::vector<Residual> residuals(count);
  tbb::parallel_for(0, count, [&](int e) {
    ElementSystem& system = workspace();
    model_.evaluate(e, state, TangentKind::none, system);
    parts[e] = part_of(e, state, system);
    residuals[e] = system.residual;
  });
  Balance sum = summarise(parts);
  sum.residual = Eigen::VectorXd::Zero(num_equations());
  if (!std::isfinite(sum.energy)) return sum;
  for (int e = 0; e < count; ++e) pattern_.add(e, residuals[e], 1, sum.residual);
  return sum;
}

Balance Assembler::linearise(const State& state, const std::vector<HermiteMesh::Node>& pending,
                             TangentKind kind) {
  const int count = model_.num_elements();
  std::fill(values_.begin(), values_.end(), 0.0);
  right_hand_side_ = Eigen::VectorXd::Zero(num_equations());
  std::vector<Balance> parts(count);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(num_equations());
  for (const auto& colour : pattern_.colours)
    tbb::parallel_for(std::size_t{0}, colour.size(), [&](std::size_t k) {
      const int e = colour[k];
      ElementSystem& system = workspace();
      model_.evaluate(e, state, kind, system);
      parts[e] = part_of(e, state, system);
      if (!std::isfinite(system.energy)) return;
      pattern_.add(e, system.residual, 1, residual);
      condense(e, pending.empty() ? Residual::Zero() : gather(e, pending), system);
      pattern_.add(e, system.residual, -1, right_hand_side_);
      scatter(e, system.tangent, values_);
    });
  Balance sum = summarise(parts);
  sum.residual = std::move(residual);
  return sum;
}

const std::vector<double>& Assembler::metric() {
  if (!metric_.empty()) return metric_;
  metric_.assign(values_.size(), 0.0);
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  for (int e = 0; e < model_.num_elements(); ++e) {
    const auto laplacian = model_.element(e).laplacian();
    for (int i = 0; i < 3; ++i)
      tangent.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * i) = laplacian;
    scatter(e, tangent, metric_);
  }
  return metric_;
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

void Assembler::scatter(int e, const Eigen::MatrixXd& tangent, std::vector<double>& values) const {
  const auto& unknowns = pattern_.unknowns[e];
  const int count = static_cast<int>(unknowns.size());
  const Stretch* stretch = pattern_.stretches[e].data();
  std::array<double, kUnknowns> factors, column;
  for (int k = 0; k < count; ++k) factors[k] = pattern_.factors[e][unknowns[k]];
  for (int k = 0; k < count; ++k) {
    const int c = unknowns[k];
    for (int i = k; i < count; ++i) {
      const int r = unknowns[i];
      const int at = std::max(r, c) + kUnknowns * std::min(r, c);
      column[i] = factors[i] * factors[k] * tangent.data()[at];
    }
    for (int i = k; i < count; i += stretch->count, ++stretch)
      add(*stretch, column.data(), values.data());
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

PressureStep Assembler::pressures_after(const State& state,
                                        const std::vector<HermiteMesh::Node>& step) const {
  const int count = model_.num_elements();
  PressureStep result{state.pressure, Eigen::MatrixXd::Zero(8, count),
                      Eigen::MatrixXd::Zero(8, count), Eigen::MatrixXd::Zero(8, count)};
  tbb::parallel_for(0, count, [&](int e) {
    const int n = model_.element(e).num_pressures();
    const auto& kept = eliminations_[e];
    const Eigen::VectorXd now = pressure_scales_[e] * pressures_of(state, e);
    const Eigen::VectorXd rate = kept.coupling.leftCols(n).transpose() * gather(e, step);
    result.now.col(e).head(n) = now;
    result.rate.col(e).head(n) = rate;
    const Eigen::VectorXd change = rate + pressure_factors_[e] * kept.residual.head(n);
    result.after.col(e).head(n) = now + change;
    Eigen::Map<Eigen::VectorXd>(result.pressure.data() + 8 * e, n) +=
        pressure_factors_[e].transpose() * change;
  });
  return result;
}

Eigen::VectorXd Assembler::against_swelling(const Eigen::MatrixXd& excess) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_equations());
  for (int e = 0; e < model_.num_elements(); ++e) {
    const int n = model_.element(e).num_pressures();
    pattern_.add(e, eliminations_[e].coupling.leftCols(n) * excess.col(e).head(n), -1, sum);
  }
  return sum;
}

Eigen::VectorXd Assembler::change_of_right_hand_side(const Model& from, const Model& to,
                                                     const State& state) const {
  std::vector<Residual> changes(model_.num_elements());
  tbb::parallel_for(0, model_.num_elements(), [&](int e) {
    const int n = model_.element(e).num_pressures();
    ElementSystem& system = workspace();
    from.evaluate(e, state, TangentKind::none, system);
    const Residual before = system.residual;
    const Eigen::VectorXd swelling_before = system.pressure_residual.head(n);
    to.evaluate(e, state, TangentKind::none, system);
    const Eigen::VectorXd swelling = system.pressure_residual.head(n) - swelling_before;
    changes[e] = system.residual - before +
                 eliminations_[e].coupling.leftCols(n) * (pressure_factors_[e] * swelling);
  });
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(num_equations());
  for (int e = 0; e < model_.num_elements(); ++e) pattern_.add(e, changes[e], -1, sum);
  return sum;
}

void Assembler::take_circulation(const State& state) {
  circulations_.resize(model_.num_elements());
  tbb::parallel_for(0, model_.num_elements(),
                    [&](int e) { circulations_[e] = model_.circulations(e, state); });
}

Eigen::VectorXd Assembler::circulation(const Eigen::VectorXd& solution) const {
  using FaceVector = Eigen::Matrix<double, 3 * Face::kFunctions, 1>;
  Eigen::VectorXd product = Eigen::VectorXd::Zero(num_equations());
  for (std::size_t e = 0; e < circulations_.size(); ++e)
    for (const auto& [face, block] : circulations_[e]) {
      const auto& equations = pattern_.equations[e];
      const auto& factors = pattern_.factors[e];
      const auto unknown = [&face = face](int k) {
        return kFunctions * (k / Face::kFunctions) + face->function(k % Face::kFunctions);
      };
      FaceVector local = FaceVector::Zero();
      for (int k = 0; k < local.size(); ++k)
        if (const int u = unknown(k); equations[u] >= 0)
          local[k] = factors[u] * solution[equations[u]];
      local = block * local;
      for (int k = 0; k < local.size(); ++k)
        if (const int u = unknown(k); equations[u] >= 0)
          product[equations[u]] += factors[u] * local[k];
    }
  return product;
}

std::vector<HermiteMesh::Node> Assembler::nodal_residual(const State& state) const {
  const HermiteMesh& mesh = model_.reference();
  std::vector<HermiteMesh::Node> residual(mesh.num_nodes(), HermiteMesh::Node::Zero());
  ElementSystem& system = workspace();
  for (int e = 0; e < mesh.num_elements(); ++e) {
    model_.evaluate(e, state, TangentKind::none, system);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < kFunctions; ++a)
        residual[mesh.corners(e)[corner_of_function(a)]](i, parameter_of_function(a)) +=
            system.residual[kFunctions * i + a];
  }
  return residual;
}

}  // namespace mammotwin
