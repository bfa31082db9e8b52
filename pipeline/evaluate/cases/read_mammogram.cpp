#include "pipeline/evaluate/cases/read_mammogram.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace mammotwin {
namespace {

using Cells = std::map<std::string, std::string>;

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

}  // namespace

std::vector<Eigen::Vector2d> ReadMammogram::marks() const {
  std::vector<Eigen::Vector2d> marks = skin;
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
      throw std::runtime_error(
          path.string() + ": row " + std::to_string(all.size() + 1) +
          ": expected file, view, pixel_mm_assumed, chest_wall and columns and rows of "
          "nipple, pectoral_top, pectoral_bottom, skin25, skin50, skin75");
    }
  }
  return all;
}

}  // namespace mammotwin
