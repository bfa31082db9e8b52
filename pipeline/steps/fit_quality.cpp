#include "pipeline/steps/fit_quality.h"

#include <sstream>
#include <stdexcept>

namespace mammotwin {
namespace {

Status status_named(const std::string& name) {
  for (const Status s : {Status::ok, Status::look, Status::refused, Status::not_converged})
    if (name_of(s) == name) return s;
  throw std::logic_error("no status is called " + name);
}

const char* name_of(StepOutcome outcome) {
  switch (outcome) {
    case StepOutcome::accepted:
      return "accepted";
    case StepOutcome::refused_by_cost:
      return "refused by cost";
    case StepOutcome::refused_by_proof:
      return "refused by proof";
  }
  return "";
}

nlohmann::json course_of(const FitReport& report) {
  nlohmann::json course = nlohmann::json::array();
  for (const FitIteration& i : report.course)
    course.push_back({{"stage", i.stage},
                      {"outcome", name_of(i.outcome)},
                      {"cost", i.cost},
                      {"skin_rms_mm", i.skin_rms_mm},
                      {"radius", i.radius}});
  return course;
}

std::vector<double> rms_of_accepted(const FitReport& report) {
  std::vector<double> rms;
  for (const FitIteration& i : report.course)
    if (i.outcome == StepOutcome::accepted) rms.push_back(i.skin_rms_mm);
  return rms;
}

nlohmann::json list_of(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

}  // namespace

Outcome judge_fit(const FitReport& r) {
  return {status_named(r.status),
          r.reasons,
          {{"elements", {r.elements.x(), r.elements.y(), r.elements.z()}},
           {"noise_mm", r.noise_mm},
           {"smoothing", r.smoothing},
           {"skin_rms_mesh_to_data_mm", r.skin_rms_mesh_to_data_mm},
           {"skin_rms_data_to_mesh_mm", r.skin_rms_data_to_mesh_mm},
           {"skin_p95_mm", r.skin_p95_mm},
           {"skin_max_mm", r.skin_max_mm},
           {"skin_max_at_lps_mm", list_of(r.farthest_in_lps)},
           {"nipple_error_mm", r.nipple_error_mm},
           {"chest_wall_rms_mm", r.chest_wall_rms_mm},
           {"min_jacobian_bound", r.min_jacobian_bound},
           {"min_scaled_jacobian", r.min_scaled_jacobian},
           {"covered_fraction", r.covered_fraction},
           {"covered_lesions", r.covered_lesions},
           {"iterations", r.iterations},
           {"course", course_of(r)},
           {"skin_rms_by_iteration_mm", rms_of_accepted(r)}}};
}

std::string fit_talk(const FitReport& report, int verbosity) {
  std::ostringstream talk;
  if (verbosity >= 1)
    for (const FitIteration& i : report.course)
      talk << i.stage << ": " << name_of(i.outcome) << ", cost " << i.cost << " mm2, skin RMS "
           << i.skin_rms_mm << " mm, trust region " << i.radius << "\n";
  if (verbosity >= 2)
    for (const std::string& text : report.solver_reports) talk << "\n" << text;
  return talk.str();
}

}  // namespace mammotwin
