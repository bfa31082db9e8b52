#include "pipeline/report/quality_table.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr std::pair<const char*, const char*> kUnits[] = {
    {"_mm", "mm"}, {"_N", "N"},       {"_cm2", "cm²"},
    {"_ml", "ml"}, {"_deg", "°"},     {"_kPa", "kPa"},
    {"_mb", "MB"}, {"_seconds", "s"}, {"_fraction", "fraction"}};

/// Shown elsewhere on the page, or not figures of quality.
constexpr const char* kElsewhere[] = {"history", "detectors", "course",
                                      "doubts",  "series",    "skin_rms_by_iteration_mm"};

std::pair<std::string, std::string> name_and_unit(std::string key) {
  std::string unit;
  for (const auto& [ending, its_unit] : kUnits) {
    const std::string end = ending;
    if (!key.ends_with(end)) continue;
    unit = its_unit;
    if (end != "_fraction" && end != "_seconds") key.resize(key.size() - end.size());
    break;
  }
  std::replace(key.begin(), key.end(), '_', ' ');
  return {key, unit};
}

bool is_plain(const json& value) {
  return !value.is_object() &&
         !(value.is_array() && !value.empty() && value.front().is_structured());
}

void unfold(const std::string& path, const json& value, std::vector<QualityFigure>& figures) {
  if (is_plain(value)) {
    const auto [name, unit] = name_and_unit(path);
    figures.push_back({name, shown_value(value), unit, ""});
    return;
  }
  std::size_t number = 0;
  for (const auto& [key, child] : value.items()) {
    ++number;
    const std::string label =
        !value.is_array() ? key
        : child.contains("id")
            ? child["id"].is_string() ? child["id"].get<std::string>() : child["id"].dump()
            : std::to_string(number);
    if (value.is_array() && child.is_object()) {
      for (const auto& [name, leaf] : child.items())
        if (name != "id") unfold(path + " " + label + ", " + name, leaf, figures);
    } else {
      unfold(path + ", " + label, child, figures);
    }
  }
}

}  // namespace

std::string shown_value(const json& value) {
  if (value.is_null()) return "not known";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g", value.get<double>());
    return text;
  }
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string text = "(";
  for (const json& item : value) text += (text.size() > 1 ? ", " : "") + shown_value(item);
  return text + ")";
}

std::vector<QualityFigure> quality_figures(const json& quality) {
  std::vector<QualityFigure> figures;
  if (!quality.is_object()) return figures;
  for (const auto& [key, value] : quality.items())
    if (std::find(std::begin(kElsewhere), std::end(kElsewhere), key) == std::end(kElsewhere)) {
      const std::size_t first = figures.size();
      unfold(key, value, figures);
      for (std::size_t n = first; n < figures.size(); ++n) figures[n].key = key;
    }
  return figures;
}

}  // namespace mammotwin
