#include "solver/newton/cholesky.h"

#include <tbb/task_group.h>

#include <algorithm>

#include "solver/newton/blas_kernels.h"
#include "solver/newton/dense_kernels.h"

namespace mammotwin {

namespace {

constexpr double kTaskFlops = 2e6;  // a smaller branch is not worth a task of its own
constexpr double kMostKept = 1e8;   // doubles, 0.8 GB: up to some 40,000 unknowns

/// Adds column j of a child's update (a lower triangle) to a column of its parent that begins at
/// its row 0; both ascend, so lower stays lower.
void add_column(const Eigen::VectorXd& update, const Front& child, int j, double* target) {
  const double* source = update.data() + j * static_cast<std::ptrdiff_t>(child.to_parent.size());
  for (const auto& [from, to, count] : child.stretches_to_parent) {
    const int above = std::max(0, j - from);
    add({from + above, to + above, count - above}, source, target);
  }
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
  gather(index, values);
  if (!eliminate(index)) definite_ = false;
}

/// Each column is cleared just before it is added to, while it is in the cache.
void Cholesky::gather(int index, const std::vector<double>& values) {
  const Front& front = tree_.fronts[index];
  const std::ptrdiff_t size = front.size(), pivots = front.num_pivots, rest = size - pivots;
  std::vector<int> next(front.children.size(), 0);  // column of each child that comes next
  const auto add_children = [&](int j, double* column) {
    for (std::size_t c = 0; c < next.size(); ++c) {
      const Front& child = tree_.fronts[front.children[c]];
      if (next[c] < static_cast<int>(child.to_parent.size()) && child.to_parent[next[c]] == j)
        add_column(updates_[front.children[c]], child, next[c]++, column);
    }
  };
  panels_[index].resize(size * pivots);
  for (int p = 0; p < pivots; ++p) {
    double* column = panels_[index].data() + p * size;
    std::fill(column + p, column + size, 0.0);
    for (int k = front.starts[p]; k < front.starts[p + 1]; ++k)
      add(front.entries[k], values.data(), column);
    add_children(p, column);
  }
  updates_[index].resize(rest * rest);
  if (front.children.empty()) return;
  for (int j = front.num_pivots; j < size; ++j) {
    double* column = updates_[index].data() + (j - pivots) * rest - pivots;
    std::fill(column + j, column + size, 0.0);
    add_children(j, column);
  }
  if (!keep_updates_)
    for (int child : front.children) updates_[child].resize(0);
}

/// The pivots' columns, and what is left for the parent.
bool Cholesky::eliminate(int index) {
  const Front& front = tree_.fronts[index];
  const Panel panel{panels_[index].data(), front.size(), front.num_pivots};
  if (!factor_panel(panel)) return false;
  const bool gathered = !front.children.empty();
  if (front.size() > front.num_pivots)
    subtract_outer_product(panel, gathered ? 1 : 0, updates_[index].data());
  return true;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = b, here;  // of a front's equations: pivots first
  const auto take = [&](const Front& front) {
    here.resize(front.size());
    for (int i = 0; i < front.size(); ++i) here[i] = x[front.equations[i]];
  };
  for (std::size_t f = 0; f < tree_.fronts.size(); ++f) {
    const Front& front = tree_.fronts[f];
    take(front);
    solve_lower({panels_[f].data(), front.size(), front.num_pivots}, here.data());
    for (int i = 0; i < front.size(); ++i) x[front.equations[i]] = here[i];
  }
  for (std::size_t f = tree_.fronts.size(); f-- > 0;) {
    const Front& front = tree_.fronts[f];
    take(front);
    solve_lower_transposed({panels_[f].data(), front.size(), front.num_pivots}, here.data());
    for (int i = 0; i < front.num_pivots; ++i) x[front.equations[i]] = here[i];
  }
  return x;
}

}  // namespace mammotwin
