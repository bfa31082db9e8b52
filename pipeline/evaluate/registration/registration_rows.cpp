#include "pipeline/evaluate/registration/registration_rows.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "pipeline/evaluate/cases/sorted_figures.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/registration/mark_coverage.h"
#include "pipeline/frame/outcome.h"
#include "pipeline/frame/settings.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/registered_view.h"
#include "registration/export/landmark_table.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSpaces[] = {"cc", "mlo", "3d"};

json median_of(const std::vector<double>& values) {
  return values.empty() ? json() : json(quantile_of(values, 0.5));
}

struct Views {
  RegisteredView cc, mlo;
  ViewRays cc_rays, mlo_rays;

  static ViewRays rays(const RegisteredView& v) {
    return {v.prone, v.compressed, v.projection.view(), v.projection.detector()};
  }
  Views(const fs::path& folder, const char* suffix, const Patient& patient)
      : cc(read_registered_view("cc", folder / (std::string("cc") + suffix), patient.cc)),
        mlo(read_registered_view("mlo", folder / (std::string("mlo") + suffix), patient.mlo)),
        cc_rays(rays(cc)),
        mlo_rays(rays(mlo)) {}

  std::map<std::string, TargetErrors> errors(const std::vector<LandmarkPair>& pairs) const {
    return target_errors(
        pairs, {{"cc", {&cc.projection, &cc_rays}}, {"mlo", {&mlo.projection, &mlo_rays}}});
  }
};

bool is_lesion(const LandmarkPair& pair) { return pair.name.front() == 'L'; }

/// The predicted mark of one view; empty where register gave no uncertainty.
std::optional<JudgedMark> judged(const RegisteredView& view, const LandmarkPair& pair) {
  const ProjectedLandmark found = view.projection.project({pair.name, *pair.mri_in_lps});
  const auto covariance = view.covariance(found.point);
  if (!covariance) return std::nullopt;
  const Eigen::Vector2d truth =
      view.projection.detector().detector_from_image(pair.marks.at(view.projection.view().name));
  return JudgedMark{is_lesion(pair), truth - found.on_detector, *covariance,
                    view.projection.detector().beside_image_mm(truth) == 0};
}

void add_coverage(const Views& views, const std::vector<LandmarkPair>& pairs, json& row) {
  std::vector<JudgedMark> lesions, points;
  row["marks"] = json::array();
  for (const RegisteredView* view : {&views.cc, &views.mlo})
    for (const LandmarkPair& pair : pairs)
      if (const auto mark = judged(*view, pair)) {
        (mark->lesion ? lesions : points).push_back(*mark);
        row["marks"].push_back(mark_json(*mark));
      }
  row["lesions"] = coverage_of(lesions);
  row["points"] = coverage_of(points);
}

void add_errors(const std::string& prefix, const std::map<std::string, TargetErrors>& errors,
                bool with_model, json& row) {
  for (const char* space : kSpaces) {
    const auto found = errors.find(space);
    const std::vector<double> values = found == errors.end() ? std::vector<double>()
                                       : with_model          ? found->second.with_model
                                                             : found->second.without_model;
    const std::string key = prefix + "tre_" + space + "_mm";
    row[key] = median_of(values);
    row["errors"][key] = values;
  }
}

}  // namespace

json empty_registration_row() {
  json row = json::object();
  for (const char* space : kSpaces)
    for (const char* prefix : {"", "before_search_", "baseline_"})
      row[std::string(prefix) + "tre_" + space + "_mm"] = nullptr;
  for (const char* kind : {"lesions", "points"}) row[kind] = coverage_of({});
  return row;
}

json registration_row(const fs::path& folder) {
  const json said = stage_sidecar(folder / "lesions.csv");
  if (said.is_object() && said.at("status") == name_of(Status::refused))
    throw std::runtime_error("register: " + said.at("reasons").at(0).get<std::string>());
  Patient patient;
  patient.read(folder / "patient.toml");
  const std::vector<LandmarkPair> pairs = read_landmark_pairs(folder / "landmarks.csv");
  json row = empty_registration_row();
  add_errors("before_search_", Views(folder, ".vtu", patient).errors(pairs), true, row);
  const Views registered(folder, "_registered.vtu", patient);
  const auto errors = registered.errors(pairs);
  add_errors("", errors, true, row);
  add_errors("baseline_", errors, false, row);
  add_coverage(registered, pairs, row);
  if (said.is_object()) {
    row["search"] = said.at("quality").value("search", json::object());
    row["register_seconds"] = said.at("seconds");
  }
  return row;
}

std::string registration_summary(const json& cases) {
  std::string text = "median, mean, 95th percentile [mm] over all landmarks; 3d from two marks\n";
  for (const char* prefix : {"before_search_", "", "baseline_"})
    for (const char* space : kSpaces) {
      const std::string key = std::string(prefix) + "tre_" + space + "_mm";
      std::vector<double> all;
      for (const json& row : cases)
        if (row.contains("errors"))
          for (const double e : row["errors"].value(key, std::vector<double>())) all.push_back(e);
      if (all.empty()) continue;
      char line[160];
      std::snprintf(line, sizeof line, "  %-26s %6.2f %6.2f %6.2f  n %zu\n", key.c_str(),
                    quantile_of(all, 0.5),
                    std::accumulate(all.begin(), all.end(), 0.0) / all.size(),
                    quantile_of(all, 0.95), all.size());
      text += line;
    }
  std::vector<std::vector<JudgedMark>> patients;
  for (const json& row : cases) {
    patients.emplace_back();
    for (const json& mark : row.value("marks", json::array()))
      patients.back().push_back(mark_of(mark));
  }
  text += coverage_summary(patients);
  return text;
}

}  // namespace mammotwin
