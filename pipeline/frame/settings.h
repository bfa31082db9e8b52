#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mammotwin {

/// What a number may be, in which unit; `hint` ends the message when it is not.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::string unit = "-";
  std::string hint = {};
};

/// Names of an enumeration's values; E comes from the variable they are for.
template <class E>
using ChoiceNames = std::type_identity_t<std::vector<std::pair<std::string, E>>>;

/// A setting's value does not fit its type or range.
class BadSetting : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One named setting, bound to a variable of an options struct.
struct Setting {
  std::string key;   ///< as in patient.toml, dotted: "views.cc.thickness_mm"
  std::string type;  ///< "number", "integer", "true or false", "text", "path", "a | b", "[x, y, z]"
  Range range;
  std::string help;
  std::function<void(const nlohmann::json&)> assign;  ///< throws BadSetting without the key's name
  std::function<nlohmann::json()> value;              ///< null where an optional one is not set

  bool starts_with(const std::string& prefix) const { return key.rfind(prefix, 0) == 0; }
  std::string range_text() const;
};

/// A name for values of other settings, as they are written on a command line.
struct Preset {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;
};

/// The table of all settings: declared once, it reads patient.toml, the command line, writes the
/// help and the parameters of a sidecar. Defaults are the bound variables' values when declared.
class Settings {
 public:
  void number(std::string key, double& variable, Range range, std::string help);
  void number(std::string key, std::optional<double>& variable, Range range, std::string help);
  void integer(std::string key, int& variable, Range range, std::string help);
  void integer(std::string key, std::optional<int>& variable, Range range, std::string help);
  void flag(std::string key, bool& variable, std::string help);
  void text(std::string key, std::optional<std::string>& variable, std::string help);
  /// Text that must not be written anywhere (an identifier): a sidecar gets a hash of it.
  void private_text(std::string key, std::optional<std::string>& variable, std::string help);
  /// A file or folder. Its name may tell who the patient is: a sidecar says only that it is given.
  void path(std::string key, std::optional<std::filesystem::path>& variable, std::string help);
  void point(std::string key, std::optional<Eigen::Vector3d>& variable, Range range,
             std::string help);
  void numbers(std::string key, std::optional<Eigen::Vector2d>& variable, Range range,
               std::string help);
  /// None, or `count` points as [[x, y], ...].
  void points(std::string key, std::vector<Eigen::Vector2d>& variable, std::size_t count,
              Range range, std::string help);
  void integers(std::string key, std::optional<Eigen::Vector3i>& variable, Range range,
                std::string help);
  void label_values(std::string key, std::vector<int>& variable, std::string help);

  template <class E>
  void choice(std::string key, E& variable, ChoiceNames<E> names, std::string help);
  template <class E>
  void choice(std::string key, std::optional<E>& variable,
              std::vector<std::pair<std::string, E>> names, std::string help);

  /// Names for sets of values of settings, all of the same ones, declared already: that which
  /// `chosen` names is taken at once. The values that a user gives stand, whether they come before
  /// the name or after it.
  void preset(std::string key, std::string& chosen, std::vector<Preset> presets, std::string help);

  const std::vector<Setting>& all() const { return settings_; }
  const Setting* find(const std::string& key) const;
  std::vector<std::string> keys() const;

  /// Throws BadSetting: "<where>: <key> is <found>; expected <type and range> (<hint>)".
  void assign(const std::string& where, const std::string& key, const nlohmann::json& value);
  /// The same from command-line text.
  void assign_text(const std::string& where, const std::string& key, const std::string& text);

  /// {"fit.smoothing": {"value": 1e-8, "unit": "-"}, ...} of the settings under these prefixes.
  nlohmann::json parameters(const std::vector<std::string>& prefixes) const;

 private:
  void add(std::string key, std::string type, Range range, std::string help,
           std::function<void(const nlohmann::json&)> assign,
           std::function<nlohmann::json()> value);
  /// One of `names`: `choose` is called with its number; `chosen` is empty where none is set.
  void add_choice(std::string key, std::vector<std::string> names, std::string help,
                  std::function<void(std::size_t)> choose,
                  std::function<std::optional<std::string>()> chosen);
  void take_preset(const Preset& preset);
  std::vector<Setting> settings_;
  std::map<std::string, std::vector<Preset>> presets_;  ///< by the setting that chooses one
  std::set<std::string> given_;                         ///< keys that a user named
};

namespace detail {
template <class E>
std::string name_of(E e, const std::vector<std::pair<std::string, E>>& names) {
  for (const auto& [name, value] : names)
    if (value == e) return name;
  throw std::logic_error("a choice has a value without a name");
}

template <class E>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, E>>& names) {
  std::vector<std::string> all;
  for (const auto& pair : names) all.push_back(pair.first);
  return all;
}

}  // namespace detail

template <class E>
void Settings::choice(std::string key, E& variable, ChoiceNames<E> names, std::string help) {
  add_choice(
      std::move(key), detail::names_of(names), std::move(help),
      [&variable, names](std::size_t n) { variable = names[n].second; },
      [&variable, names] { return std::optional(detail::name_of(variable, names)); });
}

template <class E>
void Settings::choice(std::string key, std::optional<E>& variable,
                      std::vector<std::pair<std::string, E>> names, std::string help) {
  add_choice(
      std::move(key), detail::names_of(names), std::move(help),
      [&variable, names](std::size_t n) { variable = names[n].second; },
      [&variable, names] {
        return variable ? std::optional(detail::name_of(*variable, names)) : std::nullopt;
      });
}

}  // namespace mammotwin
