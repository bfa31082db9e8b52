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

/// Adds column j of a child's update (a lower triangle of `n` rows) to a column of its parent that
/// begins at its row 0; both ascend, so lower stays lower.
void add_column(const Eigen::VectorXd& update, const std::vector<int>& to_parent, int j,
                double* target) {
  const int n = static_cast<int>(to_parent.size());
  const double* source = update.data() + static_cast<std::ptrdiff_t>(j) * n;
  for (int i = j; i < n; ++i) target[to_parent[i]] += source[i];
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
  std::vector<int> next(front.children.size(), 0);  // column of each child that comes next
  fill_panel(index, values, next);
  if (!eliminate(index)) {
    definite_ = false;
    return;
  }
  add_updates(index, next);
}

/// Each column is cleared just before it is added to, while it is in the cache.
void Cholesky::fill_panel(int index, const std::vector<double>& values, std::vector<int>& next) {
  const Front& front = tree_.fronts[index];
  const Eigen::Index size = front.size();
  panels_[index].resize(size * front.num_pivots);
  for (int p = 0; p < front.num_pivots; ++p) {
    double* column = panels_[index].data() + p * size;
    std::fill(column + p, column + size, 0.0);
    for (int k = front.starts[p]; k < front.starts[p + 1]; ++k)
      column[front.rows[k]] += values[front.sources[k]];
    for (std::size_t c = 0; c < next.size(); ++c) {
      const auto& to_parent = tree_.fronts[front.children[c]].to_parent;
      if (next[c] == static_cast<int>(to_parent.size()) || to_parent[next[c]] != p) continue;
      add_column(updates_[front.children[c]], to_parent, next[c]++, column);
    }
  }
}

/// The pivots' columns, and what they leave for the parent: written over the last factorisation's.
bool Cholesky::eliminate(int index) {
  const Front& front = tree_.fronts[index];
  double* panel = panels_[index].data();
  if (!factor_panel(panel, front.size(), front.num_pivots)) return false;
  const Eigen::Index rest = front.size() - front.num_pivots;
  updates_[index].resize(rest * rest);
  if (rest > 0)
    negative_outer_product(panel + front.num_pivots, front.size(), static_cast<int>(rest),
                           front.num_pivots, updates_[index].data());
  return true;
}

/// The children's columns from `next` on, which no pivot of this front has.
void Cholesky::add_updates(int index, const std::vector<int>& next) {
  const Front& front = tree_.fronts[index];
  const std::ptrdiff_t rest = front.size() - front.num_pivots;
  for (std::size_t c = 0; c < next.size(); ++c) {
    const int child = front.children[c];
    const auto& to_parent = tree_.fronts[child].to_parent;
    for (int j = next[c]; j < static_cast<int>(to_parent.size()); ++j)
      add_column(
          updates_[child], to_parent, j,
          updates_[index].data() + (to_parent[j] - front.num_pivots) * rest - front.num_pivots);
    if (!keep_updates_) updates_[child].resize(0);
  }
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
