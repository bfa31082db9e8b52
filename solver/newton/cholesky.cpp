#include "solver/newton/cholesky.h"

#include <tbb/task_group.h>

#include <algorithm>

#include "solver/newton/blas_kernels.h"
#include "solver/newton/dense_kernels.h"

namespace mammotwin {

namespace {

constexpr double kTaskFlops = 2e6;  // a smaller branch is not worth a task of its own
constexpr double kMostKept = 1e8;   // doubles, 0.8 GB: up to some 40,000 unknowns

using ConstMap = Eigen::Map<const Eigen::MatrixXd>;

/// Adds a child's update into its parent's panel and update; both lists ascend, so lower stays
/// lower.
void extend_add(const Eigen::VectorXd& update, const std::vector<int>& to_parent, int pivots,
                int parent_size, double* panel, double* parent_update) {
  const int n = static_cast<int>(to_parent.size());
  const int rest = parent_size - pivots;
  for (int j = 0; j < n; ++j) {
    const int column = to_parent[j];
    double* target =
        column < pivots
            ? panel + static_cast<std::ptrdiff_t>(column) * parent_size
            : parent_update + static_cast<std::ptrdiff_t>(column - pivots) * rest - pivots;
    const double* source = update.data() + static_cast<std::ptrdiff_t>(j) * n;
    for (int i = j; i < n; ++i) target[to_parent[i]] += source[i];
  }
}

/// Zeroes columns of a lower trapezium.
void clear_lower(double* columns, int rows, int count) {
  for (int j = 0; j < count; ++j)
    std::fill_n(columns + static_cast<std::ptrdiff_t>(j) * rows + j, rows - j, 0.0);
}

}  // namespace

Cholesky::Cholesky(const SparsePattern& pattern, const std::vector<int>& node_of_equation)
    : tree_(make_front_tree(pattern, node_of_equation)) {
  use_one_blas_thread();
  panels_.resize(tree_.fronts.size());
  updates_.resize(tree_.fronts.size());
  double updates = 0;
  for (const Front& front : tree_.fronts) {
    const double k = front.num_pivots, n = front.size();
    updates += (n - k) * (n - k);
    double flops = k * n * n;
    for (int child : front.children) flops += subtree_flops_[child];
    subtree_flops_.push_back(flops);
  }
  keep_updates_ = updates <= kMostKept;
}

bool Cholesky::factor(const std::vector<double>& values) {
  definite_ = true;
  for (int root : tree_.roots) factor_subtree(root, values);
  return definite_;
}

void Cholesky::factor_subtree(int index, const std::vector<double>& values) {
  const Front& front = tree_.fronts[index];
  tbb::task_group tasks;
  for (int child : front.children)
    if (subtree_flops_[child] > kTaskFlops)
      tasks.run([this, child, &values] { factor_subtree(child, values); });
  for (int child : front.children)
    if (subtree_flops_[child] <= kTaskFlops) factor_subtree(child, values);
  tasks.wait();
  if (!definite_) return;
  assemble(index, values);
  eliminate(index);
}

void Cholesky::assemble(int index, const std::vector<double>& values) {
  const Front& front = tree_.fronts[index];
  const Eigen::Index size = front.size(), rest = size - front.num_pivots;
  panels_[index].resize(size * front.num_pivots);
  updates_[index].resize(rest * rest);
  clear_lower(panels_[index].data(), size, front.num_pivots);
  clear_lower(updates_[index].data(), rest, rest);
  for (std::size_t k = 0; k < front.sources.size(); ++k)
    panels_[index][front.targets[k]] += values[front.sources[k]];
  for (int child : front.children) {
    extend_add(updates_[child], tree_.fronts[child].to_parent, front.num_pivots, front.size(),
               panels_[index].data(), updates_[index].data());
    if (!keep_updates_) updates_[child].resize(0);
  }
}

void Cholesky::eliminate(int index) {
  const Front& front = tree_.fronts[index];
  double* panel = panels_[index].data();
  if (!factor_panel(panel, front.size(), front.num_pivots)) {
    definite_ = false;
    return;
  }
  const int rest = front.size() - front.num_pivots;
  if (rest > 0)
    subtract_outer_product(panel + front.num_pivots, front.size(), rest, front.num_pivots,
                           updates_[index].data());
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = b;
  Eigen::VectorXd pivots;
  for (std::size_t f = 0; f < tree_.fronts.size(); ++f) {
    const Front& front = tree_.fronts[f];
    const int k = front.num_pivots, rest = front.size() - k;
    const ConstMap panel(panels_[f].data(), front.size(), k);
    pivots.resize(k);
    for (int i = 0; i < k; ++i) pivots[i] = x[front.equations[i]];
    solve_lower(panel.data(), front.size(), k, pivots.data());
    const Eigen::VectorXd passed_on = panel.bottomRows(rest) * pivots;
    for (int i = 0; i < k; ++i) x[front.equations[i]] = pivots[i];
    for (int i = 0; i < rest; ++i) x[front.equations[k + i]] -= passed_on[i];
  }
  Eigen::VectorXd later;
  for (std::size_t f = tree_.fronts.size(); f-- > 0;) {
    const Front& front = tree_.fronts[f];
    const int k = front.num_pivots, rest = front.size() - k;
    const ConstMap panel(panels_[f].data(), front.size(), k);
    later.resize(rest);
    for (int i = 0; i < rest; ++i) later[i] = x[front.equations[k + i]];
    pivots.resize(k);
    for (int i = 0; i < k; ++i) pivots[i] = x[front.equations[i]];
    pivots.noalias() -= panel.bottomRows(rest).transpose() * later;
    solve_lower_transposed(panel.data(), front.size(), k, pivots.data());
    for (int i = 0; i < k; ++i) x[front.equations[i]] = pivots[i];
  }
  return x;
}

}  // namespace mammotwin
