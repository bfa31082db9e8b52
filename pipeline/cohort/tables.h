#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/cohort/patient_summary.h"

namespace mammotwin {

/// Columns and rows of text, written as tab-separated lines; tabs and line ends in a value become
/// blanks.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string text() const;
};

/// patient, status, stage, reason, then every quality figure of any patient: in the chain's order,
/// a product's own by name. Empty where a patient has none.
Table cohort_table(const std::vector<PatientSummary>& cohort);

/// patient, seconds (all stages), peak_memory_mb (the largest stage), then both for each product.
Table times_table(const std::vector<PatientSummary>& cohort);

/// How to call the front door so that one patient runs again.
struct RunAgain {
  std::string front_door = "make";  ///< or "mammotwin" where the programs are installed
  /// make patient P=042 DATA="$DATA" RESULTS="$RESULTS": tables travel and do not say what folders
  /// are called here.
  std::string command(const std::string& patient) const;
};

/// patient, status, stage, reason, command that runs it again; one row a patient that failed.
Table failed_table(const std::vector<PatientSummary>& cohort, const RunAgain& again);

std::string joined(const std::vector<std::string>& sentences);

}  // namespace mammotwin
