#include "pipeline/evaluate/compression/refinement_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One breast under way: segmented, then fitted and pressed mesh by mesh.
class RefinementRun {
 public:
  RefinementRun(const BreastToPress& breast, std::string finest)
      : breast_(breast),
        finest_(std::move(finest)),
        segmentation_(breast.folder / "segmentation.seg.nrrd") {
    fs::create_directories(breast.folder);
    run_to_product({"segment", {}, segmentation_, breast.patient_toml});
  }

  json row(const std::string& mesh, const std::string& view) const {
    json row{{"name", breast_.name}, {"view", view}, {"mesh", mesh}, {"reason", nullptr}};
    for (const char* key :
         {"force_N", "force_change", "contact_area_cm2", "gap_p95_mm", "max_penetration_mm",
          "lesion_median_mm", "lesion_max_mm", "tissue_median_mm", "tissue_max_mm", "dof",
          "newton_iterations", "cpu_seconds"})
      row[key] = nullptr;
    try {
      fit(mesh);
      row["elements"] = read_mesh_file(prone(mesh)).mesh.num_elements();
      row["cpu_seconds"] = press(mesh, view);
      describe(mesh, view, row);
    } catch (const std::exception& error) {
      row["reason"] = error.what();
    }
    return row;
  }

 private:
  fs::path prone(const std::string& mesh) const { return breast_.folder / mesh / "prone.vtu"; }
  fs::path pressed(const std::string& mesh, const std::string& view) const {
    return breast_.folder / mesh / (view + ".vtu");
  }

  void fit(const std::string& mesh) const {
    fs::create_directories(prone(mesh).parent_path());
    ProductRun run{"fit",
                   {segmentation_.string(), fractions_beside(segmentation_).string()},
                   prone(mesh),
                   breast_.patient_toml};
    if (mesh != "default") {
      std::string elements = mesh;
      std::replace(elements.begin(), elements.end(), 'x', ',');
      run.options = {"--elements", "[" + elements + "]"};
    }
    run_to_product(run);
  }

  double press(const std::string& mesh, const std::string& view) const {
    return run_to_product({"compress",
                           {view, segmentation_.string(), fractions_beside(segmentation_).string(),
                            prone(mesh).string()},
                           pressed(mesh, view),
                           breast_.patient_toml});
  }

  void describe(const std::string& mesh, const std::string& view, json& row) const {
    const json quality = stage_sidecar(pressed(mesh, view)).at("quality");
    for (const char* key : {"force_N", "contact_area_cm2", "gap_p95_mm", "max_penetration_mm",
                            "dof", "newton_iterations"})
      row[key] = quality.at(key);
    const fs::path best = pressed(finest_, view);
    if (mesh == finest_ || !fs::exists(best)) return;
    const double force = stage_sidecar(best).at("quality").at("force_N");
    row["force_change"] = row.at("force_N").get<double>() / force - 1;
    add_moves(FollowedPoints(segmentation_, prone(finest_)),
              PressedPlaces(best, view, segmentation_),
              PressedPlaces(pressed(mesh, view), view, segmentation_), row);
  }

  const BreastToPress& breast_;
  const std::string finest_;
  const fs::path segmentation_;
};

}  // namespace

void add_refinement_rows(const BreastToPress& breast, const std::vector<std::string>& meshes,
                         const std::function<void(const json&)>& add) {
  const RefinementRun run(breast, meshes.front());
  for (const std::string& mesh : meshes)
    for (const char* view : {"cc", "mlo"}) add(run.row(mesh, view));
}

}  // namespace mammotwin
