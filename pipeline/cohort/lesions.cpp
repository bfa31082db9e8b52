#include "pipeline/cohort/lesions.h"

#include <fstream>

#include "registration/export/csv.h"

namespace mammotwin {
namespace {

/// False where the columns are others.
bool append_file(const std::filesystem::path& path, Table& table) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) return true;  // no lesions yet
  const std::vector<std::string> columns = csv::cells(line);
  if (table.columns.empty()) table.columns = columns;
  if (columns != table.columns) return false;
  while (std::getline(in, line)) table.rows.push_back(csv::cells(line));
  return true;
}

}  // namespace

Table lesions_table(const std::filesystem::path& results, const std::vector<PatientSummary>& cohort,
                    std::vector<std::string>& left_out) {
  Table table;
  for (const PatientSummary& patient : cohort)
    if (!append_file(results / patient.patient / "lesions.csv", table))
      left_out.push_back(patient.patient);
  return table;
}

}  // namespace mammotwin
