#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace mammotwin {

/// Where MAMMOTWIN_TABLES names a folder: rows of a page of docs/measured, into NAME.json there.
/// They take the place of those whose `key` has the same value, and others stay.
inline void show_rows(const std::string& name, const std::string& key, const nlohmann::json& rows) {
  const char* folder = std::getenv("MAMMOTWIN_TABLES");
  if (!folder || rows.empty()) return;
  const std::filesystem::path file = std::filesystem::path(folder) / (name + ".json");
  nlohmann::json cases = nlohmann::json::array();
  if (std::ifstream in(file); in) {
    const nlohmann::json before = nlohmann::json::parse(in);
    for (const nlohmann::json& row : before.at("cases"))
      if (row.at(key) != rows.front().at(key)) cases.push_back(row);
  }
  cases.insert(cases.end(), rows.begin(), rows.end());
  std::filesystem::create_directories(folder);
  std::ofstream(file) << nlohmann::json{{"cases", cases}}.dump(1) << "\n";
}

}  // namespace mammotwin
