#include "pipeline/steps/fit_quality.h"

#include <stdexcept>

namespace mammotwin {
namespace {

Status status_named(const std::string& name) {
  for (const Status s : {Status::ok, Status::look, Status::refused, Status::not_converged})
    if (name_of(s) == name) return s;
  throw std::logic_error("no status is called " + name);
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
           {"skin_rms_by_iteration_mm", r.skin_rms_by_iteration_mm}}};
}

}  // namespace mammotwin
