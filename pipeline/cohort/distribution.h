#pragma once

#include <string>
#include <vector>

#include "pipeline/cohort/patient_summary.h"

namespace mammotwin {

/// A quality figure over the cohort, its values in ascending order.
struct Distribution {
  struct Value {
    double value;
    std::string patient;
  };
  std::string name;
  std::vector<Value> values;  ///< not empty
  double first_quartile = 0, median = 0, third_quartile = 0;

  double smallest() const { return values.front().value; }
  double largest() const { return values.back().value; }
  bool is_constant() const { return smallest() == largest(); }
  /// Values more than 1.5 interquartile ranges outside the quartiles (Tukey, Exploratory Data
  /// Analysis, 1977, chapter 2); none among fewer than 5 values or where the quartiles meet.
  std::vector<Value> outliers() const;
};

/// Every numeric figure of any patient, in the order of cohort.tsv.
std::vector<Distribution> distributions_of(const std::vector<PatientSummary>& cohort);

/// Value at fraction q of sorted, not empty `values`, linear between neighbours.
double quantile(const std::vector<Distribution::Value>& values, double q);

}  // namespace mammotwin
