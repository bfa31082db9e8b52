#include "pipeline/evaluate/compression/typical_press.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/outline_row.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kMostCpuSeconds = 1800;
// How much of a breast stays in front of the plates' edge depends on how far it is pressed.
constexpr int kMostPresses = 4;
constexpr double kNearlyTypical_mm = 1.5;

/// What mammotwin-compress takes of a breast in this folder.
std::vector<std::string> inputs_in(const fs::path& from) {
  const fs::path mesh = from / (fs::exists(from / "unloaded.vtu") ? "unloaded.vtu" : "prone.vtu");
  return {"cc", (from / "segmentation.seg.nrrd").string(), (from / "fractions.nrrd").string(),
          mesh.string()};
}

}  // namespace

fs::path press_typically(const fs::path& view, const fs::path& from,
                         const OutlinePopulation& population, const fs::path& folder) {
  fs::create_directories(folder);
  const fs::path product = folder / "cc.vtu", toml = from / "patient.toml";
  fs::path seen = view;
  for (int press = 0; press < kMostPresses; ++press) {
    const json row = outline_row(read_mesh_file(seen), population);
    const double thickness = row.at("thickness_mm"), typical = row.at("typical_thickness_mm");
    if (seen == product && std::abs(typical - thickness) < kNearlyTypical_mm) break;
    run_to_product({"compress",
                    inputs_in(from),
                    product,
                    fs::exists(toml) ? toml : fs::path(),
                    {"--views-cc-thickness-mm", std::to_string(typical)},
                    kMostCpuSeconds});
    seen = product;
  }
  return product;
}

void add_plates(const fs::path& folder, const OutlinePopulation& population, json& row) {
  for (const char* key : {"press_status", "thickness_mm", "force_N", "pressure_kpa", "width_ratio",
                          "depth_ratio", "retained_fraction"})
    row[key] = nullptr;
  if (!fs::exists(folder / "unloaded.vtu")) return;
  try {
    run_to_product({"compress", inputs_in(folder), folder / "cc.vtu", folder / "patient.toml"});
    const fs::path pressed =
        press_typically(folder / "cc.vtu", folder, population, folder / "typical");
    const json sidecar = stage_sidecar(pressed), &quality = sidecar.at("quality");
    const json outline = outline_row(read_mesh_file(pressed), population);
    constexpr double kPa_per_N_per_cm2 = 10;
    row["press_status"] = sidecar.at("status");
    row["thickness_mm"] = quality.at("thickness_mm");
    row["force_N"] = quality.at("force_N");
    row["pressure_kpa"] = kPa_per_N_per_cm2 * quality.at("force_N").get<double>() /
                          quality.at("contact_area_cm2").get<double>();
    row["retained_fraction"] = quality.at("retained_fraction");
    for (const char* key : {"width_ratio", "depth_ratio"}) row[key] = outline.at(key);
  } catch (const std::exception& error) {
    if (row.at("reason").is_null()) row["reason"] = error.what();
  }
}

}  // namespace mammotwin
