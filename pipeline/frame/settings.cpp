#include "pipeline/frame/settings.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/frame/checksum.h"

namespace mammotwin {
namespace {

using nlohmann::json;

std::string short_number(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + ("\"" + names[i] + "\"");
  return text;
}

std::string text_of(const json& value) { return value.is_null() ? "empty" : value.dump(); }

std::size_t number_of(const json& value, const std::vector<std::string>& names) {
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](const std::string& name) { return value == name; });
  if (found == names.end())
    throw BadSetting("is " + text_of(value) + "; expected " + one_of(names));
  return static_cast<std::size_t>(found - names.begin());
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " | ") + name;
  return text;
}

double checked_number(const json& value, const Range& range) {
  if (!value.is_number()) throw BadSetting("is " + text_of(value) + "; expected a number");
  const double x = value.get<double>();
  if (std::isfinite(x) && x >= range.low && x <= range.high) return x;
  Setting shown;
  shown.range = range;
  throw BadSetting("is " + short_number(x) + "; expected " + shown.range_text() +
                   (range.hint.empty() ? "" : " (" + range.hint + ")"));
}

int checked_integer(const json& value, const Range& range) {
  if (!value.is_number_integer())
    throw BadSetting("is " + text_of(value) + "; expected a whole number");
  return static_cast<int>(checked_number(value, range));
}

const json& checked_list(const json& value, std::size_t size) {
  if (!value.is_array() || (size > 0 && value.size() != size))
    throw BadSetting("is " + text_of(value) + "; expected a list of " +
                     (size > 0 ? std::to_string(size) + " " : std::string()) + "numbers");
  return value;
}

template <class Vector>
Vector checked_vector(const json& value, const Range& range) {
  Vector v;
  checked_list(value, static_cast<std::size_t>(v.size()));
  for (int i = 0; i < v.size(); ++i) {
    const json& entry = value[static_cast<std::size_t>(i)];
    if constexpr (std::is_same_v<typename Vector::Scalar, int>)
      v[i] = checked_integer(entry, range);
    else
      v[i] = checked_number(entry, range);
  }
  return v;
}

template <class Vector>
json list_of(const Vector& v) {
  return json(std::vector<typename Vector::Scalar>(v.begin(), v.end()));
}

std::string checked_text(const json& value) {
  if (!value.is_string() || value.get<std::string>().empty())
    throw BadSetting("is " + text_of(value) + "; expected text in quotes");
  return value.get<std::string>();
}

bool checked_flag(const json& value) {
  if (!value.is_boolean()) throw BadSetting("is " + text_of(value) + "; expected true or false");
  return value.get<bool>();
}

/// What a command line's text says where this setting is meant.
json value_of(const std::string& text, const Setting& setting) {
  const bool is_text = setting.type == "text" || setting.type == "path" ||
                       setting.type.find(" | ") != std::string::npos;
  const bool is_list = setting.type.front() == '[';
  json value =
      json::parse(is_list && text.front() != '[' ? "[" + text + "]" : text, nullptr, false);
  if (is_text || value.is_discarded()) value = text;
  return value;
}

}  // namespace

std::string Setting::range_text() const {
  const std::string unit = range.unit == "-" ? "" : " " + range.unit;
  if (std::isfinite(range.low) && std::isfinite(range.high))
    return short_number(range.low) + " to " + short_number(range.high) + unit;
  if (std::isfinite(range.low)) return "at least " + short_number(range.low) + unit;
  if (std::isfinite(range.high)) return "at most " + short_number(range.high) + unit;
  return range.unit == "-" ? "any" : "any, in " + range.unit;
}

void Settings::add(std::string key, std::string type, Range range, std::string help,
                   std::function<void(const json&)> assign, std::function<json()> value) {
  settings_.push_back({std::move(key), std::move(type), std::move(range), std::move(help),
                       std::move(assign), std::move(value)});
}

void Settings::add_choice(std::string key, std::vector<std::string> names, std::string help,
                          std::function<void(std::size_t)> choose,
                          std::function<std::optional<std::string>()> chosen) {
  const std::string type = joined(names);
  add(
      std::move(key), type, Range{}, std::move(help),
      [names = std::move(names), choose = std::move(choose)](const json& v) {
        choose(number_of(v, names));
      },
      [chosen = std::move(chosen)] {
        const auto name = chosen();
        return name ? json(*name) : json();
      });
}

void Settings::number(std::string key, double& variable, Range range, std::string help) {
  add(
      std::move(key), "number", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_number(v, range); },
      [&variable] { return json(variable); });
}

void Settings::number(std::string key, std::optional<double>& variable, Range range,
                      std::string help) {
  add(
      std::move(key), "number", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_number(v, range); },
      [&variable] { return variable ? json(*variable) : json(); });
}

void Settings::integer(std::string key, int& variable, Range range, std::string help) {
  add(
      std::move(key), "integer", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_integer(v, range); },
      [&variable] { return json(variable); });
}

void Settings::integer(std::string key, std::optional<int>& variable, Range range,
                       std::string help) {
  add(
      std::move(key), "integer", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_integer(v, range); },
      [&variable] { return variable ? json(*variable) : json(); });
}

void Settings::flag(std::string key, bool& variable, std::string help) {
  add(
      std::move(key), "true or false", Range{}, std::move(help),
      [&variable](const json& v) { variable = checked_flag(v); },
      [&variable] { return json(variable); });
}

void Settings::text(std::string key, std::optional<std::string>& variable, std::string help) {
  add(
      std::move(key), "text", Range{}, std::move(help),
      [&variable](const json& v) { variable = checked_text(v); },
      [&variable] { return variable ? json(*variable) : json(); });
}

void Settings::private_text(std::string key, std::optional<std::string>& variable,
                            std::string help) {
  constexpr std::size_t hash_digits = 16;
  add(
      std::move(key), "text", Range{}, std::move(help),
      [&variable](const json& v) { variable = checked_text(v); },
      [&variable] {
        return variable ? json("sha256 " + sha256_of_text(*variable).substr(0, hash_digits))
                        : json();
      });
}

void Settings::path(std::string key, std::optional<std::filesystem::path>& variable,
                    std::string help) {
  add(
      std::move(key), "path", Range{}, std::move(help),
      [&variable](const json& v) { variable = checked_text(v); },
      [&variable] { return variable ? json("given") : json(); });
}

void Settings::point(std::string key, std::optional<Eigen::Vector3d>& variable, Range range,
                     std::string help) {
  add(
      std::move(key), "[x, y, z]", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_vector<Eigen::Vector3d>(v, range); },
      [&variable] { return variable ? list_of(*variable) : json(); });
}

void Settings::numbers(std::string key, std::optional<Eigen::Vector2d>& variable, Range range,
                       std::string help) {
  add(
      std::move(key), "[a, b]", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_vector<Eigen::Vector2d>(v, range); },
      [&variable] { return variable ? list_of(*variable) : json(); });
}

void Settings::points(std::string key, std::vector<Eigen::Vector2d>& variable, std::size_t count,
                      Range range, std::string help) {
  add(
      std::move(key), "[[x, y], ...]", range, std::move(help),
      [&variable, count, range](const json& v) {
        if (!v.is_array() || v.size() != count)
          throw BadSetting("is " + text_of(v) + "; expected a list of " + std::to_string(count) +
                           " points [x, y]");
        std::vector<Eigen::Vector2d> points;
        for (const json& point : v) points.push_back(checked_vector<Eigen::Vector2d>(point, range));
        variable = points;
      },
      [&variable] {
        json list = json::array();
        for (const Eigen::Vector2d& point : variable) list.push_back(list_of(point));
        return variable.empty() ? json() : list;
      });
}

void Settings::integers(std::string key, std::optional<Eigen::Vector3i>& variable, Range range,
                        std::string help) {
  add(
      std::move(key), "[n1, n2, n3]", range, std::move(help),
      [&variable, range](const json& v) { variable = checked_vector<Eigen::Vector3i>(v, range); },
      [&variable] { return variable ? list_of(*variable) : json(); });
}

void Settings::label_values(std::string key, std::vector<int>& variable, std::string help) {
  const Range range{0, 65535};
  add(
      std::move(key), "[label, ...]", range, std::move(help),
      [&variable, range](const json& v) {
        variable.clear();
        for (const json& entry : checked_list(v, 0))
          variable.push_back(checked_integer(entry, range));
      },
      [&variable] { return json(variable); });
}

void Settings::preset(std::string key, std::string& chosen, std::vector<Preset> presets,
                      std::string help) {
  std::vector<std::string> names;
  for (const Preset& preset : presets) {
    names.push_back(preset.name);
    if (preset.name == chosen) take_preset(preset);
  }
  presets_[key] = std::move(presets);
  add_choice(
      std::move(key), names, std::move(help),
      [&chosen, names](std::size_t n) { chosen = names[n]; },
      [&chosen] { return std::optional(chosen); });
}

void Settings::take_preset(const Preset& preset) {
  for (const auto& [key, text] : preset.values) {
    const Setting* setting = find(key);
    if (!setting) throw std::logic_error("a preset names " + key + ", which is no setting");
    if (!given_.count(key)) setting->assign(value_of(text, *setting));
  }
}

const Setting* Settings::find(const std::string& key) const {
  for (const Setting& s : settings_)
    if (s.key == key) return &s;
  return nullptr;
}

std::vector<std::string> Settings::keys() const {
  std::vector<std::string> keys;
  for (const Setting& s : settings_) keys.push_back(s.key);
  return keys;
}

void Settings::assign(const std::string& where, const std::string& key, const json& value) {
  const Setting* setting = find(key);
  if (!setting) throw std::logic_error("no setting is called " + key);
  try {
    setting->assign(value);
  } catch (const BadSetting& e) {
    throw BadSetting(where + " " + e.what());
  }
  given_.insert(key);
  if (const auto found = presets_.find(key); found != presets_.end())
    for (const Preset& preset : found->second)
      if (value == preset.name) take_preset(preset);
}

void Settings::assign_text(const std::string& where, const std::string& key,
                           const std::string& text) {
  const Setting* setting = find(key);
  if (!setting) throw std::logic_error("no setting is called " + key);
  assign(where, key, value_of(text, *setting));
}

json Settings::parameters(const std::vector<std::string>& prefixes) const {
  json parameters = json::object();
  for (const Setting& s : settings_)
    for (const std::string& prefix : prefixes)
      if (s.starts_with(prefix)) parameters[s.key] = {{"value", s.value()}, {"unit", s.range.unit}};
  return parameters;
}

}  // namespace mammotwin
