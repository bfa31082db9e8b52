#pragma once

#include "solver/newton/sparse_pattern.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace mammotwin {

/// Supernodal Cholesky factor of a symmetric matrix (CHOLMOD); analysed once.
///
/// The unknowns come numbered in elimination order (DofMap::number), which is only postordered.
class Cholesky {
 public:
  explicit Cholesky(const SparsePattern& pattern);
  ~Cholesky();

  /// False where the matrix is not positive definite; the factor is then of no use.
  bool factor(const std::vector<double>& values);

  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;

  double flops() const;  ///< of one factorisation

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mammotwin
