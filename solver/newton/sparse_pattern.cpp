#include "solver/newton/sparse_pattern.h"

#include <algorithm>
#include <map>
#include <utility>

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

/// Columns that lie in the same elements, as those of a node do, meet the same equations.
struct Neighbours {
  std::vector<int> group;                   ///< of each column
  std::vector<std::vector<int>> equations;  ///< of each group, in order
};

Neighbours find_neighbours(const std::vector<std::vector<int>>& elements,
                           const SparsePattern& pattern) {
  Neighbours neighbours;
  std::vector<int> seen(elements.size(), -1);
  for (std::size_t column = 0; column < elements.size(); ++column) {
    if (column == 0 || elements[column] != elements[column - 1]) {
      const int group = static_cast<int>(neighbours.equations.size());
      std::vector<int> met;
      for (int e : elements[column])
        for (int equation : pattern.equations[e])
          if (equation >= 0 && std::exchange(seen[equation], group) != group)
            met.push_back(equation);
      std::sort(met.begin(), met.end());
      neighbours.equations.push_back(std::move(met));
    }
    neighbours.group.push_back(static_cast<int>(neighbours.equations.size()) - 1);
  }
  return neighbours;
}

int place_of(int equation, const std::vector<int>& sorted) {
  return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), equation) -
                          sorted.begin());
}

void list_rows(const Neighbours& neighbours, SparsePattern& pattern) {
  const int n = static_cast<int>(neighbours.group.size());
  pattern.starts.push_back(0);
  for (int column = 0; column < n; ++column) {
    const std::vector<int>& met = neighbours.equations[neighbours.group[column]];
    pattern.rows.insert(pattern.rows.end(), met.begin() + place_of(column, met), met.end());
    pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
  }
}

void list_stretches(const Neighbours& neighbours, const std::vector<int>& equations,
                    SparsePattern& pattern) {
  std::vector<int>& unknowns = pattern.unknowns.emplace_back();
  for (int k = 0; k < kUnknowns; ++k)
    if (equations[k] >= 0) unknowns.push_back(k);
  std::stable_sort(unknowns.begin(), unknowns.end(),
                   [&](int a, int b) { return equations[a] < equations[b]; });
  // Where the element's equations stand among those that each of its columns meets.
  std::map<int, std::vector<int>> by_group;
  std::vector<Stretch>& stretches = pattern.stretches.emplace_back();
  for (std::size_t c = 0; c < unknowns.size(); ++c) {
    const int column = equations[unknowns[c]], group = neighbours.group[column];
    std::vector<int>& place = by_group[group];
    if (place.empty())
      for (int k : unknowns) place.push_back(place_of(equations[k], neighbours.equations[group]));
    const std::size_t first = stretches.size();
    for (std::size_t r = c; r < unknowns.size(); ++r)
      append(static_cast<int>(r), pattern.starts[column] + place[r] - place[c], first, stretches);
  }
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
  const Neighbours neighbours = find_neighbours(elements, pattern);
  list_rows(neighbours, pattern);
  for (const auto& equations : pattern.equations) list_stretches(neighbours, equations, pattern);
  colour(elements, pattern);
  return pattern;
}

void SparsePattern::add(int e, const Eigen::Ref<const Eigen::VectorXd>& of_element, double scale,
                        Eigen::VectorXd& sum) const {
  for (std::size_t k = 0; k < equations[e].size(); ++k)
    if (const int equation = equations[e][k]; equation >= 0)
      sum[equation] += scale * factors[e][k] * of_element[static_cast<Eigen::Index>(k)];
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
