#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mammotwin {

/// One figure of an evaluation's cases, as a page of docs/measured shows it.
struct MeasuredColumn {
  std::string key;      ///< in each case; "a.b" is key b of object a
  std::string heading;  ///< with its unit
  int digits = 2;       ///< after the point
  bool worst_is_least = false;
  std::optional<double> aim;  ///< what misses it (larger in size; below where the least is worst)
};

/// What a page of docs/measured says of the file that an evaluation wrote.
struct MeasuredPage {
  std::string name;   ///< data/NAME.json -> NAME.md
  std::string title;  ///< of the page
  std::string about;  ///< what was done on which cases, Markdown
  std::string command;
  std::string figures;  ///< that the command writes, from RESULTS/evaluation; else NAME.json there
  std::vector<std::string> case_name;   ///< keys that together name a case
  std::optional<std::string> group_by;  ///< the summary has a line for each value of this key
  bool summary = true;                  ///< where its cases are of one kind
  bool every_case = true;               ///< a table with a line for each case follows the summary
  std::vector<MeasuredColumn> columns;
};

/// The pages that a description in TOML names, one table `[[page]]` each. Throws std::runtime_error
/// naming the page and key that is missing or unknown.
std::vector<MeasuredPage> measured_pages(const nlohmann::json& tables);

/// Markdown: where asked a summary (number of cases, median and worst of each column; of truth
/// values, how many hold) and a line for each case. `evaluation` holds the list `cases`; what is
/// null or absent in a case stands empty and does not count. Throws std::runtime_error if there is
/// no such list or it is empty.
std::string measured_markdown(const MeasuredPage& page, const nlohmann::json& evaluation);

}  // namespace mammotwin
