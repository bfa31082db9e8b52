#include "pipeline/evaluate/registration/real_marks.h"

#include <array>
#include <fstream>
#include <stdexcept>

#include "registration/export/csv.h"

namespace mammotwin {
namespace {

constexpr std::array kMarkColumns = {"lesion",           "view",    "column",     "row",
                                     "pixel_spacing_mm", "spacing", "edge_column"};
enum { kLesion, kView, kColumn, kRow, kSpacing, kSpacingIs, kEdge };

std::runtime_error bad_cell(const std::string& where, int column, const std::string& found,
                            const std::string& expected) {
  return std::runtime_error(where + ": " + kMarkColumns[column] + " is \"" + found +
                            "\"; expected " + expected);
}

RealMark parse_mark(const std::vector<std::string>& cells, const std::string& where) {
  if (cells.size() != kMarkColumns.size())
    throw std::runtime_error(where + " has " + std::to_string(cells.size()) + " cells; expected " +
                             std::to_string(kMarkColumns.size()));
  const auto number = [&](int column) -> std::optional<double> {
    if (cells[column].empty()) return std::nullopt;
    return csv::number(cells[column], where + ": " + kMarkColumns[column]);
  };
  for (const int column : {kLesion, kColumn, kRow})
    if (cells[column].empty()) throw bad_cell(where, column, "", "something");
  if (cells[kView] != "cc" && cells[kView] != "mlo")
    throw bad_cell(where, kView, cells[kView], "cc or mlo");
  if (!cells[kSpacingIs].empty() && cells[kSpacingIs] != "known" && cells[kSpacingIs] != "assumed")
    throw bad_cell(where, kSpacingIs, cells[kSpacingIs], "known, assumed or nothing");
  const auto spacing = number(kSpacing);
  if (spacing && !(*spacing > 0)) throw bad_cell(where, kSpacing, cells[kSpacing], "more than 0");
  return {cells[kLesion], cells[kView],  {*number(kColumn), *number(kRow)},
          spacing,        number(kEdge), cells[kSpacingIs] == "assumed"};
}

}  // namespace

std::vector<RealMark> read_real_marks(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line))
    throw std::runtime_error(path.string() + ": cannot be read, or empty");
  const std::vector<std::string> header = csv::cells(line);
  for (std::size_t i = 0; i < kMarkColumns.size(); ++i)
    if (i >= header.size() || header[i] != kMarkColumns[i])
      throw std::runtime_error(path.string() + ": column " + std::to_string(i + 1) + " is \"" +
                               (i < header.size() ? header[i] : "") + "\"; expected \"" +
                               kMarkColumns[i] + "\"");
  std::vector<RealMark> marks;
  for (int number = 2; std::getline(in, line); ++number)
    if (!line.empty())
      marks.push_back(
          parse_mark(csv::cells(line), path.string() + ": line " + std::to_string(number)));
  return marks;
}

std::optional<PlacedMark> placed(const RealMark& mark, const Detector& detector, Side side) {
  if (detector.pixels) {
    const Eigen::Vector2d uv = detector.detector_from_image(mark.column_row);
    return PlacedMark{uv.x(), uv.y()};
  }
  if (!mark.pixel_spacing_mm || !mark.edge_column) return std::nullopt;
  const double columns = (mark.column_row.x() - *mark.edge_column) * (side == Side::left ? 1 : -1);
  return PlacedMark{columns * *mark.pixel_spacing_mm, std::nullopt};
}

}  // namespace mammotwin
