#include "pipeline/evaluate/compression/breast_stages.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/evaluate/cases/evaluation_table.h"
#include "pipeline/evaluate/cases/stage_command.h"

namespace mammotwin {

namespace fs = std::filesystem;
using nlohmann::json;

BreastStages::BreastStages(const BreastToPress& breast, bool is_drawn)
    : breast_(breast), segmentation_(breast.folder / "segmentation.seg.nrrd") {
  fs::create_directories(breast.folder);
  if (!is_drawn) run_to_product({"segment", {}, segmentation_, breast.patient_toml});
}

std::vector<std::string> BreastStages::inputs(const fs::path& mesh) const {
  return {segmentation_.string(), fractions_beside(segmentation_).string(), mesh.string()};
}

void BreastStages::fit(const fs::path& mesh, std::vector<std::string> options) const {
  fs::create_directories(mesh.parent_path());
  run_to_product({"fit",
                  {segmentation_.string(), fractions_beside(segmentation_).string()},
                  mesh,
                  breast_.patient_toml,
                  std::move(options)});
}

double BreastStages::unload(const fs::path& prone, const fs::path& unloaded,
                            std::vector<std::string> options) const {
  return run_to_product(
      {"unload", inputs(prone), unloaded, breast_.patient_toml, std::move(options)});
}

double BreastStages::press(const std::string& view, const fs::path& mesh, const fs::path& pressed,
                           std::vector<std::string> options) const {
  fs::create_directories(pressed.parent_path());
  std::vector<std::string> all = inputs(mesh);
  all.insert(all.begin(), view);
  return run_to_product(
      {"compress", std::move(all), pressed, breast_.patient_toml, std::move(options)});
}

void BreastStages::compare(const FollowedPoints& followed, const std::string& view,
                           const fs::path& base, const fs::path& changed, json& row) const {
  const auto force = [](const fs::path& pressed) {
    return stage_sidecar(pressed).at("quality").at("force_N").get<double>();
  };
  row["force_change"] = force(changed) / force(base) - 1;
  add_moves(followed, PressedPlaces(base, view, segmentation_),
            PressedPlaces(changed, view, segmentation_), row);
}

std::vector<std::string> elements_options(std::string elements) {
  std::replace(elements.begin(), elements.end(), 'x', ',');
  return {"--elements", "[" + elements + "]"};
}

void tabulate_breasts(
    const fs::path& patient_toml, const fs::path& cases, const std::vector<std::string>& only,
    const fs::path& table,
    const std::function<void(const BreastToPress&, const std::function<void(const json&)>& add)>&
        rows) {
  EvaluationTable written(table);
  const auto breasts = breasts_to_press(patient_toml, cases, only, written.folder() / table.stem());
  for (std::size_t n = 0; n < breasts.size(); ++n)
    rows(breasts[n], [&](const json& row) { written.add(n, row); });
}

}  // namespace mammotwin
