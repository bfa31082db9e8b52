#include "pipeline/evaluate/cases/sorted_figures.h"

#include <algorithm>
#include <cstddef>

namespace mammotwin {

double median_of_sorted(const std::vector<double>& sorted) {
  const std::size_t n = sorted.size();
  return (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
}

double quantile_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * (values.size() - 1) + 0.5)];
}

}  // namespace mammotwin
