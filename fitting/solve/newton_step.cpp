#include "fitting/solve/newton_step.h"

#include <tbb/parallel_for.h>

#include <Eigen/CholmodSupport>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fitting/solve/one_blas_thread.h"

namespace mammotwin {

namespace {

constexpr int node_size = 24;
constexpr int size = FitModel::element_size;
constexpr int max_halvings = 10;
constexpr double armijo = 1e-4;
// Against rounding where an element without data costs nothing to translate.
constexpr double relative_shift = 1e-9;

double total_cost(const FitModel& model, const std::vector<HermiteMesh::Node>& nodes) {
  std::vector<double> costs(model.elements().size());
  tbb::parallel_for(0, static_cast<int>(costs.size()),
                    [&](int e) { costs[e] = model.cost(nodes, e); });
  return std::accumulate(costs.begin(), costs.end(), 0.0);
}

/// CHOLMOD's workspace and settings.
struct Cholmod {
  cholmod_common common;
  Cholmod() { cholmod_start(&common); }
  ~Cholmod() { cholmod_finish(&common); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
};

/// Nodes in the order, of three, that eliminates cheapest.
std::vector<int> elimination_order(int num_nodes,
                                   const std::vector<HermiteMesh::Corners>& elements) {
  std::vector<Eigen::Triplet<double>> pairs;
  for (const HermiteMesh::Corners& corners : elements)
    for (int a : corners)
      for (int b : corners) pairs.emplace_back(std::max(a, b), std::min(a, b), 1.0);
  Eigen::SparseMatrix<double> graph(num_nodes, num_nodes);
  graph.setFromTriplets(pairs.begin(), pairs.end());
  Cholmod cholmod;
  cholmod.common.nmethods = 3;
  cholmod.common.method[0].ordering = CHOLMOD_AMD;
  cholmod.common.method[1].ordering = CHOLMOD_METIS;
  cholmod.common.method[2].ordering = CHOLMOD_NESDIS;
  cholmod_sparse view = Eigen::viewAsCholmod(std::as_const(graph).selfadjointView<Eigen::Lower>());
  cholmod_factor* symbolic = cholmod_analyze(&view, &cholmod.common);
  const int* first = static_cast<const int*>(symbolic->Perm);
  const std::vector<int> order(first, first + num_nodes);
  cholmod_free_factor(&symbolic, &cholmod.common);
  return order;
}

}  // namespace

/// Equations of the parameters that are free: lower half, and where element entries go in it.
struct NewtonStep::System {
  using Sparse = Eigen::SparseMatrix<double>;

  std::vector<HermiteMesh::Corners> elements;
  std::vector<int> equation;  ///< of parameter 24·node + p, −1 if held
  Sparse matrix;
  std::vector<std::vector<int>> places;  ///< in matrix values, of an element's lower entries; −1
  Eigen::VectorXd gradient;
  std::vector<FitModel::Quadratic> quadratics;
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> factor;

  int equation_of(int element, int p) const {
    return equation[node_size * elements[element][p / node_size] + p % node_size];
  }

  /// In the order in which nodes are eliminated: CHOLMOD would permute the matrix before every
  /// factorisation otherwise, in 8 % of a fit's time.
  void number(const HeldParameters& held) {
    int count = 0;
    equation.assign(node_size * held.size(), -1);
    for (int node : elimination_order(static_cast<int>(held.size()), elements))
      for (int p = 0; p < node_size; ++p)
        if (!held[node][p]) equation[node_size * node + p] = count++;
    matrix.resize(count, count);
    gradient.resize(count);
    quadratics.resize(elements.size());
  }

  void lay_pattern() {
    std::vector<Eigen::Triplet<double>> entries;
    for_each_entry([&](int, int, int row, int column) { entries.emplace_back(row, column, 0.0); });
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.makeCompressed();
    places.assign(elements.size(), std::vector<int>(size * size, -1));
    for_each_entry([&](int e, int at, int row, int column) {
      const int* first = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
      const int* last = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
      places[e][at] = static_cast<int>(std::lower_bound(first, last, row) - matrix.innerIndexPtr());
    });
    factor.cholmod().nmethods = 1;
    factor.cholmod().method[0].ordering = CHOLMOD_NATURAL;
    factor.cholmod().postorder = false;
    factor.analyzePattern(matrix);
  }

  /// visit(element, p + size·q, row, column) for element entries in the lower half.
  template <class Visit>
  void for_each_entry(const Visit& visit) const {
    for (int e = 0; e < static_cast<int>(elements.size()); ++e)
      for (int q = 0; q < size; ++q)
        for (int p = 0; p < size; ++p) {
          const int row = equation_of(e, p), column = equation_of(e, q);
          if (column >= 0 && row >= column) visit(e, p + size * q, row, column);
        }
  }

  double assemble(const FitModel& model, const std::vector<HermiteMesh::Node>& nodes) {
    tbb::parallel_for(0, static_cast<int>(elements.size()),
                      [&](int e) { quadratics[e] = model.quadratic(nodes, e); });
    std::fill(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), 0.0);
    gradient.setZero();
    double cost = 0;
    for (int e = 0; e < static_cast<int>(elements.size()); ++e) {
      const FitModel::Quadratic& quadratic = quadratics[e];
      cost += quadratic.cost;
      for (int p = 0; p < size; ++p)
        if (const int row = equation_of(e, p); row >= 0) gradient[row] += quadratic.gradient[p];
      for (int at = 0; at < size * size; ++at)
        if (const int place = places[e][at]; place >= 0)
          matrix.valuePtr()[place] += quadratic.hessian.data()[at];
    }
    for (int c = 0; c < matrix.cols(); ++c) {
      double& diagonal = matrix.valuePtr()[matrix.outerIndexPtr()[c]];
      diagonal += relative_shift * diagonal;
    }
    return cost;
  }
};

NewtonStep::NewtonStep(const std::vector<HermiteMesh::Corners>& elements,
                       const HeldParameters& held)
    : system_(std::make_unique<System>()) {
  system_->elements = elements;
  system_->number(held);
  system_->lay_pattern();
}

NewtonStep::~NewtonStep() = default;

StepReport NewtonStep::step(const FitModel& model, std::vector<HermiteMesh::Node>& nodes,
                            const Acceptable& acceptable) {
  const OneBlasThread one_thread;
  StepReport report;
  report.cost_before = report.cost_after = system_->assemble(model, nodes);
  system_->factor.factorize(system_->matrix);
  if (system_->factor.info() != Eigen::Success) return report;
  const Eigen::VectorXd direction = -system_->factor.solve(system_->gradient);
  const double slope = direction.dot(system_->gradient);
  for (double length = 1; length > std::pow(0.5, max_halvings); length /= 2) {
    std::vector<HermiteMesh::Node> trial = nodes;
    for (std::size_t p = 0; p < system_->equation.size(); ++p)
      if (const int row = system_->equation[p]; row >= 0)
        trial[p / node_size].data()[p % node_size] += length * direction[row];
    const double cost = total_cost(model, trial);
    if (!(cost <= report.cost_before + armijo * length * slope)) continue;
    if (acceptable && !acceptable(HermiteMesh(trial, system_->elements))) continue;
    nodes = std::move(trial);
    report.length = length;
    report.cost_after = cost;
    break;
  }
  return report;
}

}  // namespace mammotwin
