#include "pipeline/cohort/figures.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

using nlohmann::json;
constexpr std::size_t kLongestPoint = 3;

void add(const std::string& name, const json& value, std::vector<NamedValue>& figures);

void add_table(const std::string& name, const json& table, std::vector<NamedValue>& figures) {
  for (const auto& [key, value] : table.items()) add(name + "." + key, value, figures);
}

std::string id_text(const json& id) { return id.is_string() ? id.get<std::string>() : id.dump(); }

void add_list(const std::string& name, const json& list, std::vector<NamedValue>& figures) {
  const auto has_id = [](const json& item) { return item.is_object() && item.contains("id"); };
  if (std::all_of(list.begin(), list.end(), has_id)) {
    for (json item : list) {
      const std::string id = id_text(item["id"]);
      item.erase("id");
      add_table(name + "." + id, item, figures);
    }
    return;
  }
  if (list.size() > kLongestPoint) return;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].is_primitive()) add(name + "." + std::to_string(i), list[i], figures);
}

void add(const std::string& name, const json& value, std::vector<NamedValue>& figures) {
  if (value.is_object())
    add_table(name, value, figures);
  else if (value.is_array())
    add_list(name, value, figures);
  else if (!value.is_null())
    figures.emplace_back(name, value);
}

}  // namespace

std::vector<NamedValue> figures_of(const std::string& prefix, const json& quality) {
  std::vector<NamedValue> figures;
  if (quality.is_object()) add_table(prefix, quality, figures);
  std::sort(figures.begin(), figures.end(),
            [](const NamedValue& a, const NamedValue& b) { return a.first < b.first; });
  return figures;
}

}  // namespace mammotwin
