#include "pipeline/evaluate/registration/mammogram_rows.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "pipeline/evaluate/registration/line_distance.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Cells = std::map<std::string, std::string>;
using Line = std::vector<Eigen::Vector2d>;

// Right is: [mm]
constexpr double kSkin_mm = 3, kNipple_mm = 5, kFarNipple_mm = 10, kPectoral_mm = 5;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

std::optional<Eigen::Vector2d> point(const Cells& cells, const std::string& name) {
  const std::string column = cells.at(name + "_column"), row = cells.at(name + "_row");
  if (column.empty() || row.empty()) return std::nullopt;
  return Eigen::Vector2d(std::stod(column), std::stod(row));
}

ReadMammogram read_row(const std::filesystem::path& folder, const Cells& cells) {
  ReadMammogram read;
  read.file = folder / cells.at("file");
  read.view = cells.at("view");
  read.pixel_mm = std::stod(cells.at("pixel_mm_assumed"));
  read.wall_at_left = cells.at("chest_wall") == "left";
  read.nipple = point(cells, "nipple");
  const auto top = point(cells, "pectoral_top"), bottom = point(cells, "pectoral_bottom");
  if (top && bottom) read.pectoral = {*top, *bottom};
  for (const char* name : {"skin25", "skin50", "skin75"})
    if (const auto x = point(cells, name)) read.skin.push_back(*x);
  return read;
}

double worst(const Line& points, const Line& line, bool endless, double pixel_mm) {
  double most = 0;
  for (const Eigen::Vector2d& x : points)
    most = std::max(most, distance_to_line(x, line, endless) * pixel_mm);
  return most;
}

bool unsure(const json& row, const char* what) {
  const json& said = row.at("unsure");
  return std::find(said.begin(), said.end(), what) != said.end();
}

/// Rows in which a figure is known, right, wrong but said to be unsure, and wrong all the same.
json counted(const json& rows, const char* figure, const char* what, double limit) {
  int known = 0, right = 0, said = 0, wrong = 0;
  for (const json& row : rows) {
    if (!row.contains(figure) || row[figure].is_null()) continue;
    ++known;
    const bool good = row[figure].get<double>() <= limit;
    right += good;
    said += !good && unsure(row, what);
    wrong += !good && !unsure(row, what);
  }
  return {{"known", known},
          {"right", right},
          {"wrong_but_unsure", said},
          {"wrong_and_sure", wrong},
          {"limit_mm", limit}};
}

/// What errors are in standard deviations: root of the mean square, and how many are within one and
/// two; of those that are sure.
json calibration(const json& rows, const char* figure, const char* sd, const char* what) {
  int known = 0, within = 0, within_two = 0;
  double squares = 0;
  for (const json& row : rows) {
    if (!row.contains(figure) || row[figure].is_null() || row[sd].is_null() || unsure(row, what))
      continue;
    const double z = row[figure].get<double>() / row[sd].get<double>();
    ++known;
    within += z <= 1;
    within_two += z <= 2;
    squares += z * z;
  }
  return {{"known", known},
          {"within_1", within},
          {"within_2", within_two},
          {"rms", known > 0 ? json(std::sqrt(squares / known)) : json()}};
}

}  // namespace

std::vector<Eigen::Vector2d> ReadMammogram::marks() const {
  Line marks = skin;
  if (nipple) marks.push_back(*nipple);
  if (pectoral) marks.insert(marks.end(), {pectoral->first, pectoral->second});
  return marks;
}

std::vector<ReadMammogram> read_landmarks(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "landmarks.csv";
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line))
    throw std::runtime_error(path.string() +
                             ": cannot be read; expected a folder of mammograms "
                             "with their landmarks");
  const std::vector<std::string> names = split(line);
  std::vector<ReadMammogram> all;
  while (std::getline(in, line)) {
    std::vector<std::string> words = split(line);
    words.resize(std::max(words.size(), names.size()));
    Cells cells;
    for (std::size_t n = 0; n < names.size(); ++n) cells[names[n]] = words[n];
    try {
      all.push_back(read_row(folder, cells));
    } catch (const std::exception&) {
      throw std::runtime_error(path.string() + ": row " + std::to_string(all.size() + 1) +
                               ": expected file, view, pixel_mm_assumed and columns and rows of "
                               "nipple, pectoral_top, pectoral_bottom, skin25, skin50, skin75");
    }
  }
  return all;
}

json mammogram_row(const ReadMammogram& read, const MammogramFindings& found) {
  json row{{"outline_worst_mm", nullptr},
           {"nipple_mm", nullptr},
           {"nipple_sd_mm", found.nipple_sd_mm},
           {"nipple_evidence", name_of(found.evidence)},
           {"pectoral_worst_mm", nullptr},
           {"pectoral_sd_mm", nullptr},
           {"unsure", found.unsure},
           {"remarks", found.remarks}};
  if (!read.skin.empty())
    row["outline_worst_mm"] = worst(read.skin, found.outline, false, read.pixel_mm);
  if (read.nipple) row["nipple_mm"] = (*read.nipple - found.nipple).norm() * read.pixel_mm;
  if (found.pectoral) row["pectoral_sd_mm"] = found.pectoral_sd_mm;
  if (read.pectoral && found.pectoral)
    row["pectoral_worst_mm"] = worst({read.pectoral->first, read.pectoral->second},
                                     coarse(found.pectoral_curve), true, read.pixel_mm);
  return row;
}

json mammogram_counts(const json& rows) {
  int refused = 0, far = 0;
  for (const json& row : rows) {
    refused += row.contains("refused");
    far += row.contains("nipple_mm") && !row["nipple_mm"].is_null() &&
           row["nipple_mm"].get<double>() > kFarNipple_mm && !unsure(row, "nipple");
  }
  return {
      {"images", rows.size()},
      {"refused", refused},
      {"outline", counted(rows, "outline_worst_mm", "outline", kSkin_mm)},
      {"nipple", counted(rows, "nipple_mm", "nipple", kNipple_mm)},
      {"nipple_sure_beyond_10_mm", far},
      {"pectoral", counted(rows, "pectoral_worst_mm", "pectoral", kPectoral_mm)},
      {"nipple_over_sd", calibration(rows, "nipple_mm", "nipple_sd_mm", "nipple")},
      {"pectoral_over_sd", calibration(rows, "pectoral_worst_mm", "pectoral_sd_mm", "pectoral")}};
}

void commit_counted(const json& counts, const json& cases, Products& products) {
  write_text_atomically(products.write_main(),
                        json{{"counts", counts}, {"cases", cases}}.dump(1) + "\n");
  products.commit();
  std::cout << counts.dump(1) << std::endl;
}

}  // namespace mammotwin
