#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/newton/sparse_pattern.h"

namespace mammotwin {

/// A square matrix without symmetry on the (symmetric) pattern of a mesh, and its solution by
/// UMFPACK's LU, whose result does not depend on the number of threads.
class GeneralMatrix {
 public:
  explicit GeneralMatrix(const SparsePattern& pattern);
  ~GeneralMatrix();
  GeneralMatrix(const GeneralMatrix&) = delete;
  GeneralMatrix& operator=(const GeneralMatrix&) = delete;

  void clear();
  /// Adds an element's block; unknowns that are prescribed are left out.
  void add(int element, const Eigen::MatrixXd& block);

  /// False where the matrix is singular; the factors are then of no use.
  bool factor();

  /// With the factors of the last factor(), whatever was added since.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;

 private:
  const SparsePattern& pattern_;
  std::vector<int> starts_, rows_;
  std::vector<std::vector<int>> positions_;  ///< per element, column by column; -1: left out
  std::vector<double> values_;
  void *symbolic_ = nullptr, *numeric_ = nullptr;  ///< UMFPACK's
};

}  // namespace mammotwin
