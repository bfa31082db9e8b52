#include "pipeline/evaluate/cases/real_breasts.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/synthesize/option_table.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kContours = "lesions_radiologist.json";  // beside mri/

RealBreast mri_breast(const fs::path& patient) {
  const auto radiologist = json::parse(std::ifstream(patient / kContours));
  const json& lesion = radiologist.at("mri").at(0);
  const Side side = lesion.at("side") == "L" ? Side::left : Side::right;
  std::ostringstream toml;
  toml << side_toml(side) << "[mri]\npath = " << json(fs::canonical(patient / "mri").string())
       << "\n[[lesions]]\npoint_lps_mm = " << lesion.at("centroid_lps_mm") << "\n";
  return {patient.filename().string(), side, toml.str()};
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

std::string name_and_side(const RealBreast& breast) {
  return breast.name + "-" + name_of(breast.side);
}

bool is_asked(const std::string& name, const std::vector<std::string>& only) {
  return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& part) {
           return name.find(part) != std::string::npos;
         });
}

std::vector<RealBreast> real_breasts(const fs::path& cases) {
  std::vector<RealBreast> all;
  for (const LabelMapBreast& map : label_map_breasts(cases))
    all.push_back({map.exam, map.side, side_toml(map.side) + labels_toml(map.file)});
  for (const fs::path& entry : sorted_entries(cases))
    if (fs::exists(entry / kContours)) all.push_back(mri_breast(entry));
  return all;
}

}  // namespace mammotwin
