#include "solver/gravity/general_matrix.h"

#include <suitesparse/umfpack.h>

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

#include "solver/element/tensor_basis.h"

namespace mammotwin {

namespace {

/// Equations are numbered by nested dissection already (DofMap), and the diagonal is large: the
/// order is kept as it is, pivots are taken from it.
std::array<double, UMFPACK_CONTROL> control() {
  std::array<double, UMFPACK_CONTROL> control;
  umfpack_di_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_IRSTEP] = 0;  // Newton refines by itself
  return control;
}

/// Rows of every column of the whole matrix, from those of its lower triangle.
std::vector<std::vector<int>> full_columns(const SparsePattern& lower) {
  std::vector<std::vector<int>> columns(lower.num_columns());
  for (int c = 0; c < lower.num_columns(); ++c)
    for (int k = lower.starts[c]; k < lower.starts[c + 1]; ++k) {
      const int r = lower.rows[k];
      columns[c].push_back(r);
      if (r != c) columns[r].push_back(c);
    }
  for (auto& rows : columns) std::sort(rows.begin(), rows.end());
  return columns;
}

}  // namespace

GeneralMatrix::GeneralMatrix(const SparsePattern& pattern) : pattern_(pattern), starts_{0} {
  for (const auto& rows : full_columns(pattern)) {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    starts_.push_back(static_cast<int>(rows_.size()));
  }
  values_.assign(rows_.size(), 0);
  for (const auto& equations : pattern.equations) {
    auto& positions = positions_.emplace_back();
    for (int c = 0; c < kUnknowns; ++c)
      for (int r = 0; r < kUnknowns; ++r) {
        const int row = equations[r], column = equations[c];
        if (row < 0 || column < 0) {
          positions.push_back(-1);
          continue;
        }
        const auto begin = rows_.begin() + starts_[column],
                   end = rows_.begin() + starts_[column + 1];
        positions.push_back(static_cast<int>(std::lower_bound(begin, end, row) - rows_.begin()));
      }
  }
  const int n = pattern.num_columns();
  std::vector<int> as_numbered(n);
  for (int i = 0; i < n; ++i) as_numbered[i] = i;
  const auto settings = control();
  const int status = umfpack_di_qsymbolic(n, n, starts_.data(), rows_.data(), nullptr,
                                          as_numbered.data(), &symbolic_, settings.data(), nullptr);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status != UMFPACK_OK) throw std::runtime_error("UMFPACK cannot analyse the matrix");
}

GeneralMatrix::~GeneralMatrix() {
  umfpack_di_free_numeric(&numeric_);
  umfpack_di_free_symbolic(&symbolic_);
}

void GeneralMatrix::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

void GeneralMatrix::add(int e, const Eigen::MatrixXd& block) {
  const auto& factors = pattern_.factors[e];
  const int* position = positions_[e].data();
  for (int c = 0; c < kUnknowns; ++c)
    for (int r = 0; r < kUnknowns; ++r, ++position)
      if (*position >= 0) values_[*position] += factors[r] * factors[c] * block(r, c);
}

bool GeneralMatrix::factor() {
  umfpack_di_free_numeric(&numeric_);
  return umfpack_di_numeric(starts_.data(), rows_.data(), values_.data(), symbolic_, &numeric_,
                            control().data(), nullptr) == UMFPACK_OK;
}

Eigen::VectorXd GeneralMatrix::solve(const Eigen::VectorXd& right_hand_side) const {
  Eigen::VectorXd solution(right_hand_side.size());
  if (umfpack_di_solve(UMFPACK_A, starts_.data(), rows_.data(), values_.data(), solution.data(),
                       right_hand_side.data(), numeric_, control().data(), nullptr) != UMFPACK_OK)
    throw std::logic_error("a matrix that was not factored cannot be solved with");
  return solution;
}

}  // namespace mammotwin
