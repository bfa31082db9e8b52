#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/cohort/figures.h"
#include "pipeline/cohort/stage_result.h"

namespace mammotwin {

/// One patient's line in the cohort's tables.
struct PatientSummary {
  std::string patient;
  std::string status;  ///< a sidecar's status, or "interrupted" (killed), or "not_run"
  std::string stage;   ///< the last one reached; empty if none
  std::vector<std::string> reasons;
  /// The stages whose results hold together: up to the first that failed, and none that was made
  /// from other inputs than those now there.
  std::vector<StageResult> results;
  bool has_page = false;  ///< report.html is there

  bool failed() const { return status != "ok" && status != "look"; }
  std::vector<NamedValue> figures() const;
};

/// Where the cohort keeps what is not a result: RESULTS/.cohort. No patient's name begins with ".".
struct CohortFolder {
  std::filesystem::path results;
  std::filesystem::path log(const std::string& patient) const {
    return results / ".cohort" / "logs" / (patient + ".txt");
  }
  /// Holds the exit code of the patient's last run; missing while it runs and if it was killed.
  std::filesystem::path exit_code(const std::string& patient) const {
    return results / ".cohort" / "exit_codes" / patient;
  }
};

PatientSummary summarize_patient(const CohortFolder& cohort, const std::string& patient);

}  // namespace mammotwin
