#include "pipeline/frame/stage_declaration.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

std::string flag_of(std::string key) {
  std::replace_if(
      key.begin(), key.end(), [](char c) { return c == '.' || c == '_'; }, '-');
  return "--" + key;
}

std::string bracketed_range(const Setting& setting) {
  const std::string range = setting.range_text();
  return range == "any" ? "" : " [" + range + "]";
}

}  // namespace

void StageDeclaration::input(const std::string& name, fs::path& variable, const std::string& help) {
  command_.option(name, variable, help).required();
  inputs_.push_back({name, &variable, false});
}

void StageDeclaration::input_or_failure(const std::string& name, fs::path& variable,
                                        const std::string& help) {
  input(name, variable, help);
  inputs_.back().may_have_failed = true;
}

void StageDeclaration::product(const std::string& name, fs::path& variable,
                               const std::string& help) {
  command_.option(name, variable, help).required();
  product_ = &variable;
}

void StageDeclaration::options_from(const std::string& prefix, bool cut_prefix) {
  for (const Setting& setting : settings_.all()) {
    if (!setting.starts_with(prefix)) continue;
    auto given = std::make_shared<Given>();
    given->key = setting.key;
    given->flag = flag_of(cut_prefix ? setting.key.substr(prefix.size()) : setting.key);
    const nlohmann::json value = setting.value();
    command_.option(given->flag, given->text, setting.help + bracketed_range(setting))
        .described_as(setting.type, value.is_null()     ? ""
                                    : value.is_string() ? value.get<std::string>()
                                                        : value.dump());
    options_.push_back(given);
  }
}

std::vector<StageDeclaration::Given> StageDeclaration::given() const {
  std::vector<Given> given;
  for (const auto& option : options_)
    if (command_.has(option->flag)) given.push_back(*option);
  return given;
}

}  // namespace mammotwin
