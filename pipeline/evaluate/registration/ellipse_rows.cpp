#include "pipeline/evaluate/registration/ellipse_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/registration/mark_coverage.h"
#include "registration/search/search_ellipse.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr double kFarOff_mm = 20;

double size_of(const JudgedMark& mark) { return search_ellipse(mark.covariance, 0.9).major_mm; }

void add_errors(const std::vector<double>& errors, json& row) {
  row["marks"] = errors.size();
  row["median_error_mm"] = errors.empty() ? json() : json(quantile_of(errors, 0.5));
  row["p95_error_mm"] = errors.empty() ? json() : json(quantile_of(errors, 0.95));
}

json marks_row(const std::string& name, const std::vector<JudgedMark>& marks) {
  json row = coverage_of(marks);
  row["name"] = name;
  std::vector<double> errors;
  for (const JudgedMark& mark : marks) errors.push_back(mark.off.norm());
  add_errors(errors, row);
  return row;
}

std::string share_text(int n, int of) { return std::to_string(n) + " of " + std::to_string(of); }

/// `space` is "cc", "mlo" or "3d". Without a registration in one view there is none in 3-D.
bool not_registered(const json& row, const std::string& space) {
  const json search = row.value("search", json::object());
  const auto none = [&](const char* view) {
    return search.contains(view) && search[view].value("end", "") == "no registration";
  };
  return space == "3d" ? none("cc") || none("mlo") : none(space.c_str());
}

json space_row(const std::string& name, const std::string& space, const json& rows) {
  const std::string key = "tre_" + space + "_mm";
  std::vector<double> errors;
  int patients = 0, nearer = 0, far = 0, said = 0;
  for (const json& row : rows) {
    if (!row.contains("errors") || row.at(key).is_null()) continue;
    for (const double e : row["errors"].at(key)) errors.push_back(e);
    const double off = row.at(key);
    ++patients;
    nearer += off < row.at("baseline_" + key).get<double>();
    if (off <= kFarOff_mm) continue;
    ++far;
    said += not_registered(row, space);
  }
  json summary{{"name", name},
               {"nearer_than_baseline", share_text(nearer, patients)},
               {"over_20_mm_said", share_text(said, far)}};
  add_errors(errors, summary);
  return summary;
}

}  // namespace

json ellipse_rows(const json& rows) {
  std::vector<JudgedMark> all, lesions, points, inside, beside;
  for (const json& row : rows)
    for (const json& mark : row.value("marks", json::array())) {
      all.push_back(mark_of(mark));
      (all.back().lesion ? lesions : points).push_back(all.back());
      (all.back().in_image ? inside : beside).push_back(all.back());
    }
  json table{marks_row("all marks", all), marks_row("lesions", lesions),
             marks_row("points of gland", points), marks_row("in the image", inside),
             marks_row("beside the image", beside)};
  std::stable_sort(all.begin(), all.end(), [](const JudgedMark& a, const JudgedMark& b) {
    return size_of(a) < size_of(b);
  });
  const std::size_t n = all.size();
  const char* thirds[] = {"smallest third", "middle third", "largest third"};
  for (std::size_t t = 0; t < 3; ++t)
    table.push_back(marks_row(thirds[t], {all.begin() + t * n / 3, all.begin() + (t + 1) * n / 3}));
  table.push_back(space_row("CC", "cc", rows));
  table.push_back(space_row("MLO", "mlo", rows));
  table.push_back(space_row("3-D", "3d", rows));
  return table;
}

}  // namespace mammotwin
