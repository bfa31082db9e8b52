#include "pipeline/report/verdict.h"

#include <algorithm>
#include <iterator>

namespace mammotwin {
namespace {

using nlohmann::json;

struct Grade {
  const char *status, *text, *verdict;
};
/// From good to bad.
constexpr Grade kGrades[] = {
    {"ok", "ok", "Checks passed"},
    {"look", "look", "Look: done, but check what is said here first"},
    {"not_converged", "not converged", "Not converged: the computation did not come to an end"},
    {"refused", "refused", "Refused: the input cannot serve"},
};

const Grade* grade_of(const std::string& status) {
  const auto found = std::find_if(std::begin(kGrades), std::end(kGrades),
                                  [&](const Grade& g) { return status == g.status; });
  return found == std::end(kGrades) ? nullptr : found;
}

std::string stage_of(const StageRecord& record) {
  return record.sidecar.value("stage", record.product);
}

/// Messages often begin with their stage's name, which the page sets before them anyway.
std::string without_prefix(const std::string& text, const std::string& stage) {
  return text.starts_with(stage + ": ") ? text.substr(stage.size() + 2) : text;
}

/// Without seconds and memory, which would make the page another at every run.
json stage_row(const StageRecord& record) {
  const std::string status = record.sidecar.value("status", "unknown");
  const Grade* grade = grade_of(status);
  return {{"stage", stage_of(record)},
          {"product", record.product},
          {"status", status},
          {"status_text", grade ? grade->text : status}};
}

}  // namespace

json verdict_data(const PatientResults& results) {
  const Grade* worst = &kGrades[0];
  json reasons = json::array(), stages = json::array();
  for (const StageRecord& record : results.stages) {
    const Grade* grade = grade_of(record.sidecar.value("status", ""));
    if (grade && grade > worst) worst = grade;
    for (const json& reason : record.sidecar.value("reasons", json::array()))
      if (reason.is_string())
        reasons.push_back({{"stage", stage_of(record)},
                           {"text", without_prefix(reason.get<std::string>(), stage_of(record))}});
    stages.push_back(stage_row(record));
  }
  std::string status = worst->status, verdict = worst->verdict;
  if (worst < &kGrades[2] && !results.sidecar("lesions.csv")) {
    status = "incomplete";
    verdict = "Incomplete: the chain has not come to lesion positions yet";
  }
  return {{"status", status},
          {"verdict", verdict},
          {"reasons", reasons},
          {"has_reasons", !reasons.empty()},
          {"number_of_reasons",
           std::to_string(reasons.size()) + (reasons.size() == 1 ? " remark" : " remarks")},
          {"stages", stages}};
}

}  // namespace mammotwin
