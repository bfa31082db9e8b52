#include "pipeline/evaluate/compression/typical_press.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/outline_row.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr int kMostCpuSeconds = 1800;

}  // namespace

fs::path press_typically(const fs::path& view, const fs::path& from,
                         const OutlinePopulation& population, const fs::path& folder) {
  fs::create_directories(folder);
  const auto row = outline_row(read_mesh_file(view), population);
  const fs::path mesh = from / (fs::exists(from / "unloaded.vtu") ? "unloaded.vtu" : "prone.vtu");
  const fs::path product = folder / "cc.vtu";
  std::vector<std::string> words{"cc",
                                 (from / "segmentation.seg.nrrd").string(),
                                 (from / "fractions.nrrd").string(),
                                 mesh.string(),
                                 product.string(),
                                 "--views-cc-thickness-mm",
                                 std::to_string(row["typical_thickness_mm"].get<double>())};
  if (fs::exists(from / "patient.toml"))
    words.insert(words.end(), {"--patient", (from / "patient.toml").string()});
  const StageEnd end = run_stage_command("compress", words, folder / "cc.log", kMostCpuSeconds);
  if (end.exit_code == 0) return product;
  const auto sidecar = stage_sidecar(product);
  throw std::runtime_error("not pressed to the thickness that is typical: " +
                           (sidecar.is_object() && !sidecar.at("reasons").empty()
                                ? sidecar.at("reasons").front().get<std::string>()
                                : "compress ended with code " + std::to_string(end.exit_code)));
}

}  // namespace mammotwin
