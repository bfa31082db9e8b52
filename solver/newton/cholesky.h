#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "solver/newton/front_tree.h"
#include "solver/newton/sparse_pattern.h"

namespace mammotwin {

/// Multifrontal Cholesky factor of a symmetric matrix; analysed once.
///
/// Branches of the elimination tree and tiles of large fronts run in parallel on single-threaded
/// BLAS; tiles have a fixed size and sums a fixed order, so the factor is bit for bit the same at
/// any number of threads. `make bench` runs CHOLMOD on the same matrices.
class Cholesky {
 public:
  /// `pattern` must outlive this.
  Cholesky(const SparsePattern& pattern, const std::vector<int>& node_of_equation);

  /// False where the matrix is not positive definite; the factor is then of no use.
  bool factor(const std::vector<double>& values);

  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;

  double flops() const { return tree_.flops(); }  ///< of one factorisation

 private:
  void factor_subtree(int front, const std::vector<double>& values);
  void gather(int front, const std::vector<double>& values);
  bool eliminate(int front);

  FrontTree tree_;
  std::vector<double> subtree_flops_;
  // Lower triangles, column by column; what stands above them is never read.
  std::vector<Eigen::VectorXd> panels_;   ///< pivots' columns of each front
  std::vector<Eigen::VectorXd> updates_;  ///< what a front passes on
  bool keep_updates_ = true;  ///< memory stays for the next factorisation: no new pages to touch
  std::atomic<bool> definite_{true};
};

}  // namespace mammotwin
