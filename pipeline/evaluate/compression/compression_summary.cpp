#include "pipeline/evaluate/compression/compression_summary.h"

#include <functional>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace mammotwin {
namespace {

using nlohmann::json;

bool is_synthetic(const json& row) { return row.contains("hard"); }
bool is_hard(const json& row) { return is_synthetic(row) && row.at("hard").get<bool>(); }

void count(std::ostream& out, const json& rows, const char* what,
           const std::function<bool(const json&)>& belongs) {
  int possible = 0, reached = 0, impossible = 0;
  for (const json& row : rows) {
    if (!belongs(row)) continue;
    row.at("possible").get<bool>() ? ++possible : ++impossible;
    reached += row.at("reached").get<bool>();
  }
  if (possible + impossible == 0) return;
  out << std::left << std::setw(24) << what << reached << " of " << possible << " reached";
  if (impossible > 0) out << ", " << impossible << " more cannot be pressed so far";
  out << "\n";
}

void number(std::ostream& out, const json& row, const char* key, int digits, const char* unit) {
  if (row.contains(key) && row[key].is_number())
    out << "  " << std::fixed << std::setprecision(digits) << row[key].get<double>() << unit;
}

}  // namespace

std::string line_of(const json& row) {
  std::ostringstream out;
  out << std::left << std::setw(16) << row.at("name").get<std::string>() << std::setw(4)
      << row.at("view").get<std::string>()
      << (row.at("reached").get<bool>() ? " reached" : " FAILED ");
  number(out, row, "volume_ml", 0, " ml");
  number(out, row, "stiffness_ratio", 1, ":1");
  number(out, row, "target_fraction", 2, " asked");
  number(out, row, "compressed_fraction", 2, " got");
  number(out, row, "newton_iterations", 0, " iterations");
  number(out, row, "cpu_seconds", 0, " s CPU");
  if (!row.at("reason").is_null()) out << "  " << row.at("reason").get<std::string>();
  return out.str();
}

std::string compression_summary(const json& rows) {
  std::ostringstream out;
  for (const json& row : rows)
    if (!row.at("reached").get<bool>()) out << line_of(row) << "\n";
  count(out, rows, "synthetic", is_synthetic);
  count(out, rows, "of these hard", is_hard);
  count(out, rows, "patients, to 55 mm", [](const json& row) { return !is_synthetic(row); });
  return out.str();
}

}  // namespace mammotwin
