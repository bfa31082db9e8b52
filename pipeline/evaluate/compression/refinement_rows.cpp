#include "pipeline/evaluate/compression/refinement_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One breast under way: fitted and pressed mesh by mesh.
class RefinementRun {
 public:
  RefinementRun(const BreastToPress& breast, std::string finest)
      : stages_(breast), finest_(std::move(finest)) {}

  json row(const std::string& mesh, const std::string& view) const {
    json row{{"name", stages_.breast().name}, {"view", view}, {"mesh", mesh}, {"reason", nullptr}};
    for (const char* key :
         {"force_N", "force_change", "contact_area_cm2", "gap_p95_mm", "max_penetration_mm",
          "lesion_median_mm", "lesion_max_mm", "tissue_median_mm", "tissue_max_mm", "dof",
          "newton_iterations", "cpu_seconds"})
      row[key] = nullptr;
    try {
      fit(mesh);
      row["elements"] = read_mesh_file(prone(mesh)).mesh.num_elements();
      row["cpu_seconds"] = stages_.press(view, prone(mesh), pressed(mesh, view));
      describe(mesh, view, row);
    } catch (const std::exception& error) {
      row["reason"] = error.what();
    }
    return row;
  }

 private:
  fs::path folder(const std::string& mesh) const { return stages_.breast().folder / mesh; }
  fs::path prone(const std::string& mesh) const { return folder(mesh) / "prone.vtu"; }
  fs::path pressed(const std::string& mesh, const std::string& view) const {
    return folder(mesh) / (view + ".vtu");
  }

  void fit(const std::string& mesh) const {
    if (mesh == "default") return stages_.fit(prone(mesh));
    stages_.fit(prone(mesh), elements_options(mesh));
  }

  void describe(const std::string& mesh, const std::string& view, json& row) const {
    const json quality = stage_sidecar(pressed(mesh, view)).at("quality");
    for (const char* key : {"force_N", "contact_area_cm2", "gap_p95_mm", "max_penetration_mm",
                            "dof", "newton_iterations"})
      row[key] = quality.at(key);
    const fs::path best = pressed(finest_, view);
    if (mesh == finest_ || !fs::exists(best)) return;
    stages_.compare(FollowedPoints(stages_.segmentation(), prone(finest_)), view, best,
                    pressed(mesh, view), row);
  }

  const BreastStages stages_;
  const std::string finest_;
};

}  // namespace

void add_refinement_rows(const BreastToPress& breast, const std::vector<std::string>& meshes,
                         const std::function<void(const json&)>& add) {
  const RefinementRun run(breast, meshes.front());
  for (const std::string& mesh : meshes)
    for (const char* view : {"cc", "mlo"}) add(run.row(mesh, view));
}

}  // namespace mammotwin
