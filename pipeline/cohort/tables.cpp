#include "pipeline/cohort/tables.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace mammotwin {
namespace {

std::string cell(std::string value) {
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return value;
}

std::string line_of(const std::vector<std::string>& values) {
  if (values.empty()) return "";
  std::string line;
  for (const std::string& value : values) line.append(cell(value)).push_back('\t');
  line.back() = '\n';
  return line;
}

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Product names of all patients, in the chain's order: each patient's list is in that order, so a
/// name goes right before the first known one that follows it.
std::vector<std::string> products_of(const std::vector<PatientSummary>& cohort) {
  std::vector<std::string> order;
  for (const PatientSummary& patient : cohort) {
    auto place = order.end();
    for (auto result = patient.results.rbegin(); result != patient.results.rend(); ++result) {
      const auto known = std::find(order.begin(), order.end(), result->short_name());
      place = known != order.end() ? known : order.insert(place, result->short_name());
    }
  }
  return order;
}

std::vector<std::string> figure_columns(const std::vector<PatientSummary>& cohort) {
  std::map<std::string, std::set<std::string>> names_by_product;
  for (const PatientSummary& patient : cohort)
    for (const NamedValue& figure : patient.figures())
      names_by_product[figure.first.substr(0, figure.first.find('.'))].insert(figure.first);
  std::vector<std::string> columns;
  for (const std::string& product : products_of(cohort))
    for (const std::string& name : names_by_product[product]) columns.push_back(name);
  return columns;
}

}  // namespace

std::string Table::text() const {
  std::string text = line_of(columns);
  for (const auto& row : rows) text += line_of(row);
  return text;
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

Table cohort_table(const std::vector<PatientSummary>& cohort) {
  const std::vector<std::string> names = figure_columns(cohort);
  Table table{{"patient", "status", "stage", "reason"}, {}};
  table.columns.insert(table.columns.end(), names.begin(), names.end());
  for (const PatientSummary& patient : cohort) {
    std::map<std::string, std::string> value;
    for (const NamedValue& figure : patient.figures()) value[figure.first] = text_of(figure.second);
    std::vector<std::string> row{patient.patient, patient.status, patient.stage,
                                 joined(patient.reasons)};
    for (const std::string& name : names) row.push_back(value[name]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table times_table(const std::vector<PatientSummary>& cohort) {
  const std::vector<std::string> products = products_of(cohort);
  Table table{{"patient", "seconds", "peak_memory_mb"}, {}};
  for (const std::string& product : products)
    for (const char* what : {".seconds", ".peak_memory_mb"})
      table.columns.push_back(product + what);
  for (const PatientSummary& patient : cohort) {
    double seconds = 0, peak_memory_mb = 0;
    std::map<std::string, const StageResult*> by_name;
    for (const StageResult& result : patient.results) {
      seconds += result.seconds;
      peak_memory_mb = std::max(peak_memory_mb, result.peak_memory_mb);
      by_name[result.short_name()] = &result;
    }
    std::vector<std::string> row{patient.patient, nlohmann::json(seconds).dump(),
                                 nlohmann::json(peak_memory_mb).dump()};
    for (const std::string& product : products) {
      const StageResult* result = by_name[product];
      row.push_back(result ? nlohmann::json(result->seconds).dump() : "");
      row.push_back(result ? nlohmann::json(result->peak_memory_mb).dump() : "");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string RunAgain::command(const std::string& patient) const {
  return front_door + " patient P=" + patient + R"( DATA="$DATA" RESULTS="$RESULTS")";
}

Table failed_table(const std::vector<PatientSummary>& cohort, const RunAgain& again) {
  Table table{{"patient", "status", "stage", "reason", "command"}, {}};
  for (const PatientSummary& patient : cohort)
    if (patient.failed())
      table.rows.push_back({patient.patient, patient.status, patient.stage, joined(patient.reasons),
                            again.command(patient.patient)});
  return table;
}

}  // namespace mammotwin
