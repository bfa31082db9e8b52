#include "solver/element/tensor_basis.h"

#include <algorithm>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/gauss.h"

namespace mammotwin {

namespace {

HermiteTable make_table() {
  HermiteTable table;
  const auto rule = gauss_rule(kPoints1d);
  std::copy(rule.points.begin(), rule.points.end(), table.points.begin());
  std::copy(rule.weights.begin(), rule.weights.end(), table.weights.begin());
  for (int q = 0; q < kPoints1d; ++q) {
    const auto values = hermite_values(rule.points[q]);
    const auto slopes = hermite_first_derivatives(rule.points[q]);
    for (int t = 0; t < 4; ++t) {
      table.value[q][t] = values[t];
      table.slope[q][t] = slopes[t];
    }
  }
  return table;
}

}  // namespace

const HermiteTable& hermite_table() {
  static const HermiteTable table = make_table();
  return table;
}

}  // namespace mammotwin
