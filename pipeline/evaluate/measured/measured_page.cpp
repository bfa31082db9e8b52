#include "pipeline/evaluate/measured/measured_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "pipeline/evaluate/cases/sorted_figures.h"

namespace mammotwin {
namespace {

using nlohmann::json;

void check_keys(const json& table, const std::set<std::string>& known, const std::string& where) {
  for (const auto& [key, value] : table.items())
    if (!known.count(key)) throw std::runtime_error(where + ": unknown key \"" + key + "\"");
}

std::string text_at(const json& table, const char* key, const std::string& where) {
  if (!table.contains(key) || !table.at(key).is_string())
    throw std::runtime_error(where + ": expected the text \"" + key + "\"");
  return table.at(key).get<std::string>();
}

MeasuredColumn column_of(const json& table, const std::string& where) {
  check_keys(table, {"key", "heading", "digits", "worst", "aim"}, where);
  MeasuredColumn column;
  column.key = text_at(table, "key", where);
  column.heading = text_at(table, "heading", where);
  column.digits = table.value("digits", column.digits);
  column.worst_is_least = table.value("worst", std::string("largest")) == "least";
  if (table.contains("aim")) column.aim = table.at("aim").get<double>();
  return column;
}

MeasuredPage page_of(const json& table) {
  MeasuredPage page;
  page.name = text_at(table, "name", "[[page]]");
  const std::string where = "[[page]] " + page.name;
  check_keys(table,
             {"name", "title", "about", "command", "figures", "case_name", "group_by", "summary",
              "every_case", "columns"},
             where);
  page.title = text_at(table, "title", where);
  page.about = text_at(table, "about", where);
  page.command = text_at(table, "command", where);
  page.figures = table.value("figures", page.name + ".json");
  page.case_name = table.value("case_name", std::vector<std::string>{"name"});
  if (table.contains("group_by")) page.group_by = text_at(table, "group_by", where);
  page.summary = table.value("summary", true);
  page.every_case = table.value("every_case", true);
  for (const json& column : table.value("columns", json::array()))
    page.columns.push_back(column_of(column, where));
  if (page.columns.empty()) throw std::runtime_error(where + ": expected \"columns\"");
  return page;
}

/// Null where the case has no such value.
json value_of(const json& row, const std::string& key) {
  const std::size_t dot = key.find('.');
  const std::string head = key.substr(0, dot);
  if (!row.is_object() || !row.contains(head)) return nullptr;
  return dot == std::string::npos ? row.at(head) : value_of(row.at(head), key.substr(dot + 1));
}

std::string in_words(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string number_text(double value, const MeasuredColumn& column) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", column.digits, value);
  const bool missed =
      column.aim && (column.worst_is_least ? value < *column.aim : std::abs(value) > *column.aim);
  return missed ? "**" + std::string(text) + "**" : text;
}

std::string cell_of(const json& value, const MeasuredColumn& column) {
  if (value.is_null()) return "";
  if (value.is_number()) return number_text(value.get<double>(), column);
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "**no**";
  if (!value.is_array()) return in_words(value);
  std::string list;
  for (const json& item : value) list += (list.empty() ? "" : ", ") + in_words(item);
  return list;
}

/// "median, worst" of numbers, "held of all" of truth values; empty for text.
std::string summary_cell(const std::vector<const json*>& rows, const MeasuredColumn& column) {
  std::vector<double> numbers;
  int held = 0, asked = 0;
  for (const json* row : rows) {
    const json value = value_of(*row, column.key);
    if (value.is_number()) numbers.push_back(value.get<double>());
    if (value.is_boolean()) ++asked, held += value.get<bool>();
  }
  if (asked > 0) return std::to_string(held) + " of " + std::to_string(asked);
  if (numbers.empty()) return "";
  std::sort(numbers.begin(), numbers.end());
  const double worst =
      column.worst_is_least || -numbers.front() > numbers.back() ? numbers.front() : numbers.back();
  return number_text(median_of_sorted(numbers), column) + ", " + number_text(worst, column);
}

/// A case that came to nothing may have no group.
std::string group_of(const MeasuredPage& page, const json& row) {
  if (!page.group_by) return "all";
  const json value = value_of(row, *page.group_by);
  return value.is_null() ? "none" : in_words(value);
}

std::string name_of(const MeasuredPage& page, const json& row) {
  std::string name;
  for (const std::string& key : page.case_name) {
    const json value = value_of(row, key);
    if (!value.is_null()) name += (name.empty() ? "" : " ") + in_words(value);
  }
  return name;
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string header(std::vector<std::string> first, const MeasuredPage& page) {
  for (const MeasuredColumn& column : page.columns) first.push_back(column.heading);
  std::string rule = "|";
  for (std::size_t n = 0; n < first.size(); ++n) rule += "---|";
  return line(first) + rule + "\n";
}

std::string summary_table(const MeasuredPage& page, const json& cases) {
  std::vector<std::string> groups;
  for (const json& row : cases)
    if (std::find(groups.begin(), groups.end(), group_of(page, row)) == groups.end())
      groups.push_back(group_of(page, row));
  std::string text = header({page.group_by.value_or("cases"), "number"}, page);
  for (const std::string& group : groups) {
    std::vector<const json*> rows;
    for (const json& row : cases)
      if (group_of(page, row) == group) rows.push_back(&row);
    std::vector<std::string> cells{group, std::to_string(rows.size())};
    for (const MeasuredColumn& column : page.columns) cells.push_back(summary_cell(rows, column));
    text += line(cells);
  }
  return text;
}

std::string case_table(const MeasuredPage& page, const json& cases) {
  std::string text = header({"case"}, page);
  for (const json& row : cases) {
    std::vector<std::string> cells{name_of(page, row)};
    for (const MeasuredColumn& column : page.columns)
      cells.push_back(cell_of(value_of(row, column.key), column));
    text += line(cells);
  }
  return text;
}

}  // namespace

std::vector<MeasuredPage> measured_pages(const json& tables) {
  std::vector<MeasuredPage> pages;
  for (const json& table : tables) pages.push_back(page_of(table));
  return pages;
}

std::string measured_markdown(const MeasuredPage& page, const json& evaluation) {
  if (!evaluation.is_object() || !evaluation.contains("cases") ||
      !evaluation.at("cases").is_array() || evaluation.at("cases").empty())
    throw std::runtime_error(page.name + ".json: expected a list \"cases\" with at least one case");
  const json& cases = evaluation.at("cases");
  std::string text = "# " + page.title + "\n\n" + page.about + "\n\nMeasured by `" + page.command +
                     "`; this page is written by `make measured` from [data/" + page.name +
                     ".json](data/" + page.name + ".json). ";
  if (page.summary)
    text += "Numbers are median, worst; bold misses its aim.\n\n" + summary_table(page, cases) +
            (page.every_case ? "\n## Every case\n\n" : "");
  else
    text += "Bold misses its aim.\n\n";
  if (page.every_case) text += case_table(page, cases);
  return text;
}

}  // namespace mammotwin
