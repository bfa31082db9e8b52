#include "pipeline/evaluate/compression/gravity_row.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/frame/products.h"
#include "pipeline/steps/breast_problem.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<HermiteMesh::Node> configuration(const MeshFile& file, const std::string& name) {
  const auto found = file.configurations.find(name);
  if (found == file.configurations.end())
    throw std::runtime_error("no equilibrium was found " + name);
  return found->second;
}

}  // namespace

SupineMoves supine_moves(const MeshFile& unloaded, Side side,
                         const Eigen::Vector3d& nipple_in_lps) {
  return SupinePoints(prone_file(unloaded), side, nipple_in_lps)
      .moves(configuration(unloaded, "supine"));
}

json gravity_row(const RealBreast& breast, const fs::path& folder,
                 const std::vector<std::string>& unload_options) {
  json row{{"name", breast.name}, {"side", name_of(breast.side)}};
  for (const char* key :
       {"status", "reason", "nipple_l_mm", "nipple_p_mm", "nipple_s_mm", "nipple_mm", "landmark_mm",
        "ribs_prone_mm", "ribs_supine_mm", "cpu_seconds"})
    row[key] = nullptr;
  const BreastToPress files{name_and_side(breast), folder / "patient.toml", folder};
  const fs::path prone = folder / "prone.vtu", unloaded = folder / "unloaded.vtu";
  try {
    fs::create_directories(folder);
    write_text_atomically(files.patient_toml, patient_toml_of(breast));
    const BreastStages stages(files);
    stages.fit(prone);
    fs::remove(unloaded);
    fs::remove(unloaded.string() + ".json");
    row["cpu_seconds"] = stages.unload(prone, unloaded, unload_options);
    const SupineMoves moves = supine_moves(
        read_mesh_file(unloaded), breast.side,
        read_segmentation(stages.segmentation(), fractions_beside(stages.segmentation()))
            .nipple_in_lps);
    row["nipple_l_mm"] = moves.nipple.x();
    row["nipple_p_mm"] = moves.nipple.y();
    row["nipple_s_mm"] = moves.nipple.z();
    row["nipple_mm"] = moves.nipple.norm();
    row["landmark_mm"] = moves.landmark_mm;
    row["ribs_prone_mm"] = moves.ribs_prone_mm;
    row["ribs_supine_mm"] = moves.ribs_supine_mm;
  } catch (const std::exception& error) {
    row["reason"] = error.what();
  }
  if (const json sidecar = stage_sidecar(unloaded); sidecar.is_object())
    row["status"] = sidecar.at("status");
  return row;
}

}  // namespace mammotwin
