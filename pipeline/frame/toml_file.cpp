#include "pipeline/frame/toml_file.h"

#include <toml++/toml.h>

#include <stdexcept>

namespace mammotwin {
namespace {

using nlohmann::json;

json json_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* list = node.as_array()) {
    json values = json::array();
    for (const toml::node& entry : *list) values.push_back(json_of(entry));
    return values;
  }
  if (const auto* table = node.as_table()) {
    json values = json::object();
    for (const auto& [key, entry] : *table) values[std::string(key.str())] = json_of(entry);
    return values;
  }
  return nullptr;  // dates and times: no setting has one, so assigning it is refused
}

void walk(const toml::table& table, const std::string& prefix, TomlValues& values) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const auto* inner = node.as_table())
      walk(*inner, name + ".", values);
    else
      values.emplace_back(name, json_of(node));
  }
}

}  // namespace

TomlValues read_toml(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw std::runtime_error(file.string() + ": no such file; a patient's folder needs one");
  try {
    TomlValues values;
    walk(toml::parse_file(file.string()), "", values);
    return values;
  } catch (const toml::parse_error& e) {
    throw std::runtime_error(file.string() + ": line " + std::to_string(e.source().begin.line) +
                             ", column " + std::to_string(e.source().begin.column) + ": " +
                             std::string(e.description()));
  }
}

}  // namespace mammotwin
