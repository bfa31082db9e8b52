#include "pipeline/patient.h"

#include <stdexcept>

#include "pipeline/frame/nearest_name.h"
#include "pipeline/frame/toml_file.h"

namespace mammotwin {

void Patient::declare(Settings& settings) { (void)settings; }

void Patient::read(const std::filesystem::path& file, const Settings& settings) {
  folder_ = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  for (const auto& [key, value] : read_toml(file)) {
    if (!settings.find(key))
      throw std::runtime_error(file.string() + ": unknown key " + key +
                               "; the nearest known one is " + nearest_name(key, settings.keys()));
    settings.assign(file.string() + ": " + key, key, value);
  }
}

std::filesystem::path Patient::resolve(const std::filesystem::path& path) const {
  return path.is_absolute() ? path : folder_ / path;
}

nlohmann::json Patient::list_parameters(const std::vector<std::string>&) const {
  return nlohmann::json::object();
}

}  // namespace mammotwin
