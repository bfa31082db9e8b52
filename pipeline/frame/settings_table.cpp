#include "pipeline/frame/settings_table.h"

#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, "\\");
  return text;
}

std::string default_of(const Setting& setting) {
  const nlohmann::json value = setting.value();
  if (value.is_null() || value == nlohmann::json::array()) return "";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string row_of(const Setting& s) {
  return "| `" + s.key + "` | " + escaped(s.type) + " | " + s.range_text() + " | " + default_of(s) +
         " | " + escaped(s.help) + " |\n";
}

}  // namespace

std::string settings_table(const Settings& once, const Settings& in_lists) {
  std::string table = "| key | type | range | default | meaning |\n|---|---|---|---|---|\n";
  for (const Settings* settings : {&once, &in_lists})
    for (const Setting& s : settings->all()) table += row_of(s);
  return table;
}

}  // namespace mammotwin
