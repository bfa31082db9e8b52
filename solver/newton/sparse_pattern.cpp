#include "solver/newton/sparse_pattern.h"

#include <algorithm>

#include "solver/element/tensor_basis.h"
#include "solver/newton/model.h"

namespace mammotwin {

namespace {

void list_equations(const HermiteMesh& mesh, const DofMap& dofs, SparsePattern& pattern) {
  for (const auto& corners : mesh.elements()) {
    std::vector<int> equations(kUnknowns);
    std::vector<double> factors(kUnknowns);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < kFunctions; ++a) {
        const int dof = dof_index(corners[corner_of_function(a)], parameter_of_function(a), i);
        equations[kFunctions * i + a] = dofs.equation(dof);
        factors[kFunctions * i + a] = dofs.factor(dof);
      }
    pattern.equations.push_back(equations);
    pattern.factors.push_back(factors);
  }
}

std::vector<std::vector<int>> elements_of_equations(const SparsePattern& pattern, int n) {
  std::vector<std::vector<int>> elements(n);
  for (std::size_t e = 0; e < pattern.equations.size(); ++e)
    for (int equation : pattern.equations[e])
      if (equation >= 0 && (elements[equation].empty() || elements[equation].back() != int(e)))
        elements[equation].push_back(static_cast<int>(e));
  return elements;
}

void list_rows(const std::vector<std::vector<int>>& elements, SparsePattern& pattern) {
  const int n = static_cast<int>(elements.size());
  std::vector<int> seen(n, -1), column_rows;
  pattern.starts.push_back(0);
  for (int column = 0; column < n; ++column) {
    column_rows.clear();
    for (int e : elements[column])
      for (int row : pattern.equations[e])
        if (row >= column && seen[row] != column) {
          seen[row] = column;
          column_rows.push_back(row);
        }
    std::sort(column_rows.begin(), column_rows.end());
    pattern.rows.insert(pattern.rows.end(), column_rows.begin(), column_rows.end());
    pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
  }
}

std::vector<int> element_positions(const SparsePattern& pattern,
                                   const std::vector<int>& equations) {
  std::vector<int> positions;
  positions.reserve(kUnknowns * (kUnknowns + 1) / 2);
  for (int c = 0; c < kUnknowns; ++c)
    for (int r = c; r < kUnknowns; ++r) {
      const int row = std::max(equations[r], equations[c]);
      const int column = std::min(equations[r], equations[c]);
      if (column < 0) {
        positions.push_back(-1);
        continue;
      }
      const auto first = pattern.rows.begin() + pattern.starts[column];
      const auto last = pattern.rows.begin() + pattern.starts[column + 1];
      positions.push_back(
          static_cast<int>(std::lower_bound(first, last, row) - pattern.rows.begin()));
    }
  return positions;
}

/// Greedy colouring in element order.
void colour(const std::vector<std::vector<int>>& elements, SparsePattern& pattern) {
  const int count = static_cast<int>(pattern.equations.size());
  std::vector<int> colour_of(count, -1);
  for (int e = 0; e < count; ++e) {
    std::vector<char> taken(pattern.colours.size() + 1, 0);
    for (int equation : pattern.equations[e]) {
      if (equation < 0) continue;
      for (int other : elements[equation])
        if (colour_of[other] >= 0) taken[colour_of[other]] = 1;
    }
    const int c = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (c == static_cast<int>(pattern.colours.size())) pattern.colours.emplace_back();
    colour_of[e] = c;
    pattern.colours[c].push_back(e);
  }
}

}  // namespace

SparsePattern make_sparse_pattern(const HermiteMesh& mesh, const DofMap& dofs) {
  SparsePattern pattern;
  list_equations(mesh, dofs, pattern);
  const auto elements = elements_of_equations(pattern, dofs.num_equations());
  list_rows(elements, pattern);
  for (const auto& equations : pattern.equations)
    pattern.positions.push_back(element_positions(pattern, equations));
  colour(elements, pattern);
  return pattern;
}

Eigen::VectorXd multiply(const SparsePattern& pattern, const std::vector<double>& values,
                         const Eigen::VectorXd& x) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  for (int c = 0; c < pattern.num_columns(); ++c)
    for (int k = pattern.starts[c]; k < pattern.starts[c + 1]; ++k) {
      const int r = pattern.rows[k];
      product[r] += values[k] * x[c];
      if (r != c) product[c] += values[k] * x[r];
    }
  return product;
}

}  // namespace mammotwin
