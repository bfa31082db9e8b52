#include "pipeline/evaluate/registration/mark_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "registration/search/search_ellipse.h"

namespace mammotwin {
namespace {

using nlohmann::json;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / values.size();
}

/// Fraction of the marks inside their ellipse, and the median of its semi-major axis.
void add_ellipse(const std::vector<JudgedMark>& marks, double probability, const std::string& name,
                 json& row) {
  std::vector<double> inside, major;
  for (const JudgedMark& mark : marks) {
    const SearchEllipse ellipse = search_ellipse(mark.covariance, probability);
    inside.push_back(contains(ellipse, mark.off));
    major.push_back(ellipse.major_mm);
  }
  row["inside_" + name] = mean(inside);
  row["major_" + name + "_mm"] = quantile_of(major, 0.5);
}

/// Of the mean over patients; the marks of one are wrong together, so patients are what is counted.
double standard_error(const std::vector<json>& rows, const char* key) {
  std::vector<double> values;
  for (const json& row : rows) values.push_back(row[key]);
  if (values.size() < 2) return 0;
  double sum = 0;
  for (const double v : values) sum += std::pow(v - mean(values), 2);
  return std::sqrt(sum / (values.size() - 1) / values.size());
}

std::string line_of(const char* what, const std::vector<std::vector<JudgedMark>>& patients) {
  std::vector<JudgedMark> all;
  std::vector<json> rows;
  for (const std::vector<JudgedMark>& marks : patients) {
    if (marks.empty()) continue;
    rows.push_back(coverage_of(marks));
    all.insert(all.end(), marks.begin(), marks.end());
  }
  if (all.empty()) return "";
  const json c = coverage_of(all);
  const double error = c["median_error_mm"];
  char line[240];
  std::snprintf(line, sizeof line,
                "  %-8s in the 50 %% ellipse %.0f +- %.0f %%, in the 90 %% one %.0f +- %.0f %% of "
                "%zu marks in "
                "%zu patients; median error %.2f mm, major semi-axes %.2f and %.2f mm (%.2f and "
                "%.2f times)\n",
                what, 100 * c["inside_50"].get<double>(), 100 * standard_error(rows, "inside_50"),
                100 * c["inside_90"].get<double>(), 100 * standard_error(rows, "inside_90"),
                all.size(), rows.size(), error, c["major_50_mm"].get<double>(),
                c["major_90_mm"].get<double>(), c["major_50_mm"].get<double>() / error,
                c["major_90_mm"].get<double>() / error);
  return line;
}

}  // namespace

json mark_json(const JudgedMark& mark) {
  return {
      {"lesion", mark.lesion},
      {"in_image", mark.in_image},
      {"off_mm", {mark.off.x(), mark.off.y()}},
      {"covariance_mm2", {mark.covariance(0, 0), mark.covariance(0, 1), mark.covariance(1, 1)}}};
}

JudgedMark mark_of(const json& mark) {
  const auto off = mark.at("off_mm").get<std::array<double, 2>>();
  const auto c = mark.at("covariance_mm2").get<std::array<double, 3>>();
  JudgedMark judged{mark.at("lesion"), {off[0], off[1]}, {}};
  judged.covariance << c[0], c[1], c[1], c[2];
  judged.in_image = mark.at("in_image");
  return judged;
}

json coverage_of(const std::vector<JudgedMark>& marks) {
  json row;
  for (const char* key :
       {"inside_50", "inside_90", "major_50_mm", "major_90_mm", "median_error_mm"})
    row[key] = nullptr;
  if (marks.empty()) return row;
  add_ellipse(marks, 0.5, "50", row);
  add_ellipse(marks, 0.9, "90", row);
  std::vector<double> errors;
  for (const JudgedMark& mark : marks) errors.push_back(mark.off.norm());
  row["median_error_mm"] = quantile_of(errors, 0.5);
  return row;
}

std::string coverage_summary(const std::vector<std::vector<JudgedMark>>& patients) {
  std::vector<std::vector<JudgedMark>> lesions(patients.size()), points(patients.size());
  for (std::size_t n = 0; n < patients.size(); ++n)
    for (const JudgedMark& mark : patients[n]) (mark.lesion ? lesions : points)[n].push_back(mark);
  return line_of("lesions", lesions) + line_of("points", points) + line_of("all", patients);
}

}  // namespace mammotwin
