#include "pipeline/evaluate/compression/typical_press.h"

#include <array>
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

constexpr std::array kOfPress = {"press_status", "force_N", "pressure_kpa", "retained_fraction"};
constexpr std::array kOfOutline = {"thickness_mm", "width_ratio", "depth_ratio"};

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

void add_press(const fs::path& view, json& row) {
  constexpr double kPa_per_N_per_cm2 = 10;
  for (const char* key : kOfPress) row[key] = nullptr;
  const json sidecar = stage_sidecar(view);
  if (sidecar.is_null()) return;
  const json& quality = sidecar.at("quality");
  row["press_status"] = sidecar.at("status");
  for (const char* key : {"force_N", "retained_fraction"}) row[key] = quality.at(key);
  row["pressure_kpa"] = kPa_per_N_per_cm2 * quality.at("force_N").get<double>() /
                        quality.at("contact_area_cm2").get<double>();
}

void add_plates(const fs::path& folder, const OutlinePopulation& population, json& row) {
  for (const char* key : kOfPress) row[key] = nullptr;
  for (const char* key : kOfOutline) row[key] = nullptr;
  if (!fs::exists(folder / "unloaded.vtu")) return;
  try {
    run_to_product({"compress", inputs_in(folder), folder / "cc.vtu", folder / "patient.toml"});
    const fs::path pressed =
        press_typically(folder / "cc.vtu", folder, population, folder / "typical");
    add_press(pressed, row);
    const json outline = outline_row(read_mesh_file(pressed), population);
    for (const char* key : kOfOutline) row[key] = outline.at(key);
  } catch (const std::exception& error) {
    if (row.at("reason").is_null()) row["reason"] = error.what();
  }
}

}  // namespace mammotwin
