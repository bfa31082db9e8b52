#include "pipeline/evaluate/compression/other_mesh_rows.h"

#include <stdexcept>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One breast under way: segmented and fitted, then pressed with both meshes.
class OtherMeshRun {
 public:
  OtherMeshRun(const BreastToPress& breast, const fs::path& other)
      : stages_(breast), other_(other), prone_(breast.folder / "prone.vtu") {
    stages_.fit(prone_);
  }

  json row(const std::string& view) const {
    json row{{"name", stages_.breast().name}, {"view", view}, {"reason", nullptr}};
    for (const char* key : {"force_N", "force_change", "lesion_median_mm", "lesion_max_mm",
                            "tissue_median_mm", "tissue_max_mm", "cpu_seconds"})
      row[key] = nullptr;
    try {
      row["elements"] = read_mesh_file(prone_).mesh.num_elements();
      row["other_elements"] = read_mesh_file(other_).mesh.num_elements();
      const fs::path ours = stages_.breast().folder / (view + ".vtu"),
                     theirs = stages_.breast().folder / "other" / (view + ".vtu");
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
      return stages_.press(view, mesh, pressed);
    } catch (const std::exception& error) {
      throw std::runtime_error((mesh == other_ ? "other mesh, " : "our mesh, ") +
                               std::string(error.what()));
    }
  }

  void compare(const fs::path& ours, const fs::path& theirs, json& row) const {
    row["force_N"] = stage_sidecar(ours).at("quality").at("force_N");
    stages_.compare(FollowedPoints(stages_.segmentation(), prone_), row.at("view"), theirs, ours,
                    row);
  }

  const BreastStages stages_;
  const fs::path other_, prone_;
};

}  // namespace

void add_other_mesh_rows(const BreastToPress& breast, const OtherMesh& other,
                         const std::function<void(const json&)>& add) {
  const OtherMeshRun run(breast, other.mesh);
  for (const std::string& view : other.views) add(run.row(view));
}

}  // namespace mammotwin
