#include "pipeline/cohort/patient_summary.h"

#include <algorithm>
#include <fstream>
#include <optional>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int kFirstSignal = 128;  // a shell says 128 + n of a program that signal n ended

std::optional<int> read_exit_code(const fs::path& file) {
  int code = 0;
  return std::ifstream(file) >> code ? std::optional(code) : std::nullopt;
}

/// What the log of a run says of its end, where no sidecar does.
struct LoggedEnd {
  std::string stage;   ///< from run_patient.sh's "<patient> stopped at <stage>;"
  std::string reason;  ///< from a stage's "<stage>: refused: <reason>", otherwise the last line
};

LoggedEnd read_log(const fs::path& file, const std::string& patient) {
  const std::string stopped = patient + " stopped at ";
  const std::string refused = ": refused: ";
  std::ifstream in(file);
  LoggedEnd end;
  bool has_reason = false;
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(refused);
    if (line.rfind(stopped, 0) == 0) {
      end.stage = line.substr(stopped.size(), line.find(';') - stopped.size());
    } else if (at != std::string::npos && !has_reason) {
      end.reason = line.substr(at + refused.size());
      has_reason = true;
    } else if (!has_reason && line.find_first_not_of(" \t\r") != std::string::npos) {
      end.reason = line;
    }
  }
  return end;
}

bool made_from_others(const StageResult& result, const std::vector<StageResult>& earlier) {
  return std::any_of(earlier.begin(), earlier.end(), [&](const StageResult& before) {
    return std::any_of(result.inputs.begin(), result.inputs.end(), [&](const auto& input) {
      const auto output = before.outputs.find(input.first);
      return output != before.outputs.end() && output->second != input.second;
    });
  });
}

/// A view that no equilibrium was found in: `register` goes on with the other.
bool is_done_without(const StageResult& failed, const std::vector<StageResult>& all) {
  return std::any_of(all.begin(), all.end(), [&](const StageResult& result) {
    return result.inputs.contains(failed.product + ".json");
  });
}

std::vector<StageResult> results_that_hold_together(const std::vector<StageResult>& all) {
  std::vector<StageResult> kept;
  for (const StageResult& result : all) {
    if (made_from_others(result, kept)) break;
    kept.push_back(result);
    if (!result.usable() && !is_done_without(result, all)) break;
  }
  return kept;
}

/// The chain ends with `register`; `report` only shows it.
bool is_whole(const std::vector<StageResult>& results) {
  return std::any_of(results.begin(), results.end(),
                     [](const StageResult& result) { return result.stage == "register"; });
}

void judge_as_interrupted(PatientSummary& summary, const std::string& how) {
  summary.status = "interrupted";
  summary.reasons = {how};
}

void judge_from_log(PatientSummary& summary, int code, const fs::path& log) {
  const LoggedEnd end = read_log(log, summary.patient);
  if (!end.stage.empty()) summary.stage = end.stage;
  if (code > kFirstSignal)
    return judge_as_interrupted(summary, "ended by signal " + std::to_string(code - kFirstSignal) +
                                             " (out of memory, or killed?)");
  summary.status = "refused";
  summary.reasons = {end.reason};
}

void judge_finished(PatientSummary& summary) {
  summary.status = "ok";
  for (const StageResult& result : summary.results) {
    if (result.status != "look") continue;
    summary.status = "look";
    for (const std::string& reason : result.reasons)
      summary.reasons.push_back(result.short_name() + ": " + reason);
  }
}

void judge(PatientSummary& summary, const CohortFolder& cohort) {
  const auto code = read_exit_code(cohort.exit_code(summary.patient));
  const fs::path log = cohort.log(summary.patient);
  const auto failed = std::find_if(summary.results.begin(), summary.results.end(),
                                   [](const StageResult& result) { return !result.usable(); });
  if (failed != summary.results.end()) {
    summary.stage = failed->stage;
    summary.status = failed->status;
    summary.reasons = failed->reasons;
  } else if (code && *code != 0) {
    judge_from_log(summary, *code, log);
  } else if (!code && fs::exists(log)) {
    judge_as_interrupted(summary, "the run ended without an exit code (killed, or out of time?)");
  } else if (summary.results.empty()) {
    summary.status = "not_run";
    summary.reasons = {"not run yet"};
  } else if (!is_whole(summary.results)) {
    judge_as_interrupted(summary, "the results that fit together end at " + summary.stage);
  } else {
    judge_finished(summary);
  }
}

}  // namespace

std::vector<NamedValue> PatientSummary::figures() const {
  std::vector<NamedValue> all;
  for (const StageResult& result : results) {
    const auto some = figures_of(result.short_name(), result.quality);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

PatientSummary summarize_patient(const CohortFolder& cohort, const std::string& patient) {
  const fs::path folder = cohort.results / patient;
  PatientSummary summary;
  summary.patient = patient;
  summary.results = results_that_hold_together(read_stage_results(folder));
  summary.has_page = fs::exists(folder / "report.html");
  if (!summary.results.empty()) summary.stage = summary.results.back().stage;
  judge(summary, cohort);
  return summary;
}

}  // namespace mammotwin
