#include "pipeline/evaluate/cases/real_breasts.h"

#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipeline/evaluate/cases/case_arguments.h"
#include "pipeline/synthesize/option_table.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kContours = "lesions_radiologist.json";  // beside mri/

RealBreast mri_breast(const fs::path& patient) {
  const auto radiologist = json::parse(std::ifstream(patient / kContours));
  const json& lesion = radiologist.at("mri").at(0);
  const auto centroid = lesion.at("centroid_lps_mm").get<std::array<double, 3>>();
  return {patient.filename().string(),
          lesion.at("side") == "L" ? Side::left : Side::right,
          patient / "mri",
          false,
          {Eigen::Vector3d(centroid.data())}};
}

}  // namespace

std::string side_toml(Side side) { return "side = \"" + name_of(side) + "\"\n"; }

std::string labels_toml(const fs::path& label_map) {
  std::map<std::string, json> values;
  for (const auto& [value, tissue] : label_map_values()) values[to_string(tissue)].push_back(value);
  std::ostringstream toml;
  toml << "[labels]\npath = " << json(fs::canonical(label_map).string()) << "\n";
  for (const auto& [tissue, list] : values) toml << tissue << " = " << list << "\n";
  return toml.str();
}

std::string patient_toml_of(const RealBreast& breast) {
  std::ostringstream toml;
  toml << side_toml(breast.side);
  if (!breast.preset.empty()) toml << "materials.preset = " << json(breast.preset) << "\n";
  if (breast.is_label_map)
    toml << labels_toml(breast.image);
  else
    toml << "[mri]\npath = " << json(fs::canonical(breast.image).string()) << "\n";
  for (const Eigen::Vector3d& x : breast.lesions)
    toml << "[[lesions]]\npoint_lps_mm = " << json{x.x(), x.y(), x.z()} << "\n";
  return toml.str();
}

std::string name_and_side(const RealBreast& breast) {
  return breast.name + "-" + name_of(breast.side);
}

std::vector<RealBreast> real_breasts(const fs::path& cases) {
  std::vector<RealBreast> all;
  for (const LabelMapBreast& map : label_map_breasts(cases))
    all.push_back({map.exam, map.side, map.file});
  for (const fs::path& entry : sorted_entries(cases))
    if (fs::exists(entry / kContours)) all.push_back(mri_breast(entry));
  return all;
}

std::vector<RealBreast> asked_breasts(const fs::path& cases, const std::vector<std::string>& only) {
  std::vector<RealBreast> breasts = real_breasts(cases);
  std::erase_if(breasts,
                [&](const auto& breast) { return !is_asked(name_and_side(breast), only); });
  if (breasts.empty()) throw std::runtime_error(cases.string() + ": no such breast in it");
  return breasts;
}

}  // namespace mammotwin
