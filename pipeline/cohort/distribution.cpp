#include "pipeline/cohort/distribution.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pipeline/cohort/tables.h"

namespace mammotwin {
namespace {

constexpr std::size_t kFewestForOutliers = 5;
constexpr double kFence = 1.5;  // interquartile ranges

void sort_and_summarize(Distribution& d) {
  std::sort(d.values.begin(), d.values.end(),
            [](const Distribution::Value& a, const Distribution::Value& b) {
              return std::tie(a.value, a.patient) < std::tie(b.value, b.patient);
            });
  d.first_quartile = quantile(d.values, 0.25);
  d.median = quantile(d.values, 0.5);
  d.third_quartile = quantile(d.values, 0.75);
}

}  // namespace

double quantile(const std::vector<Distribution::Value>& values, double q) {
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double weight = at - static_cast<double>(below);
  return (1 - weight) * values[below].value + weight * values[above].value;
}

std::vector<Distribution::Value> Distribution::outliers() const {
  const double range = third_quartile - first_quartile;
  std::vector<Value> outside;
  if (values.size() < kFewestForOutliers || range <= 0) return outside;
  for (const Value& v : values)
    if (v.value < first_quartile - kFence * range || v.value > third_quartile + kFence * range)
      outside.push_back(v);
  return outside;
}

std::vector<Distribution> distributions_of(const std::vector<PatientSummary>& cohort) {
  std::map<std::string, Distribution> by_name;
  for (const PatientSummary& patient : cohort)
    for (const NamedValue& figure : patient.figures()) {
      if (!figure.second.is_number()) continue;
      Distribution& d = by_name[figure.first];
      d.name = figure.first;
      d.values.push_back({figure.second.get<double>(), patient.patient});
    }
  std::vector<Distribution> ordered;
  for (const std::string& column : cohort_table(cohort).columns) {
    const auto found = by_name.find(column);
    if (found == by_name.end()) continue;
    sort_and_summarize(found->second);
    ordered.push_back(std::move(found->second));
  }
  return ordered;
}

}  // namespace mammotwin
