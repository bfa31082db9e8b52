#include "pipeline/evaluate/compression/other_mesh_rows.h"

#include <stdexcept>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One breast under way: segmented and fitted, then pressed with both meshes.
class OtherMeshRun {
 public:
  OtherMeshRun(const BreastToPress& breast, const fs::path& other)
      : breast_(breast),
        other_(other),
        segmentation_(breast.folder / "segmentation.seg.nrrd"),
        prone_(breast.folder / "prone.vtu") {
    fs::create_directories(breast.folder / "other");
    run_to_product({"segment", {}, segmentation_, breast.patient_toml});
    run_to_product({"fit",
                    {segmentation_.string(), fractions_beside(segmentation_).string()},
                    prone_,
                    breast.patient_toml});
  }

  json row(const std::string& view) const {
    json row{{"name", breast_.name}, {"view", view}, {"reason", nullptr}};
    for (const char* key : {"force_N", "force_change", "lesion_median_mm", "lesion_max_mm",
                            "tissue_median_mm", "tissue_max_mm", "cpu_seconds"})
      row[key] = nullptr;
    try {
      row["elements"] = read_mesh_file(prone_).mesh.num_elements();
      row["other_elements"] = read_mesh_file(other_).mesh.num_elements();
      const fs::path ours = breast_.folder / (view + ".vtu"),
                     theirs = breast_.folder / "other" / (view + ".vtu");
      row["cpu_seconds"] = press(view, prone_, ours);
      press(view, other_, theirs);
      compare(ours, theirs, row);
    } catch (const std::exception& error) {
      row["reason"] = error.what();
    }
    return row;
  }

 private:
  double press(const std::string& view, const fs::path& mesh, const fs::path& pressed) const {
    try {
      return run_to_product(
          {"compress",
           {view, segmentation_.string(), fractions_beside(segmentation_).string(), mesh.string()},
           pressed,
           breast_.patient_toml});
    } catch (const std::exception& error) {
      throw std::runtime_error((mesh == other_ ? "other mesh, " : "our mesh, ") +
                               std::string(error.what()));
    }
  }

  void compare(const fs::path& ours, const fs::path& theirs, json& row) const {
    const auto force = [](const fs::path& pressed) {
      return stage_sidecar(pressed).at("quality").at("force_N").get<double>();
    };
    row["force_N"] = force(ours);
    row["force_change"] = force(ours) / force(theirs) - 1;
    const std::string view = row.at("view");
    add_moves(FollowedPoints(segmentation_, prone_), PressedPlaces(theirs, view, segmentation_),
              PressedPlaces(ours, view, segmentation_), row);
  }

  const BreastToPress& breast_;
  const fs::path other_, segmentation_, prone_;
};

}  // namespace

void add_other_mesh_rows(const BreastToPress& breast, const OtherMesh& other,
                         const std::function<void(const json&)>& add) {
  const OtherMeshRun run(breast, other.mesh);
  for (const std::string& view : other.views) add(run.row(view));
}

}  // namespace mammotwin
