#include "registration/export/lesion_table.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "registration/export/csv.h"

namespace mammotwin {
namespace {

using Text = std::string LesionRow::*;
using Number = std::optional<double> LesionRow::*;
struct Column {
  const char* name;
  std::variant<Text, Number> field;
};

#define MAMMOTWIN_COLUMN(name) \
  Column { #name, &LesionRow::name }
const std::array kLesionColumns = {
    MAMMOTWIN_COLUMN(patient),
    MAMMOTWIN_COLUMN(lesion),
    MAMMOTWIN_COLUMN(view),
    MAMMOTWIN_COLUMN(side),
    MAMMOTWIN_COLUMN(volume_ml),
    MAMMOTWIN_COLUMN(mri_l_mm),
    MAMMOTWIN_COLUMN(mri_p_mm),
    MAMMOTWIN_COLUMN(mri_s_mm),
    MAMMOTWIN_COLUMN(depth_mm),
    MAMMOTWIN_COLUMN(lateral_mm),
    MAMMOTWIN_COLUMN(height_mm),
    MAMMOTWIN_COLUMN(detector_u_mm),
    MAMMOTWIN_COLUMN(detector_v_mm),
    MAMMOTWIN_COLUMN(pixel_column),
    MAMMOTWIN_COLUMN(pixel_row),
    MAMMOTWIN_COLUMN(slice),
    MAMMOTWIN_COLUMN(ellipse_major_mm),
    MAMMOTWIN_COLUMN(ellipse_minor_mm),
    MAMMOTWIN_COLUMN(ellipse_angle_deg),
    MAMMOTWIN_COLUMN(picture_ellipse_major_mm),
    MAMMOTWIN_COLUMN(picture_ellipse_minor_mm),
    MAMMOTWIN_COLUMN(picture_ellipse_angle_deg),
    MAMMOTWIN_COLUMN(baseline_u_mm),
    MAMMOTWIN_COLUMN(baseline_v_mm),
    MAMMOTWIN_COLUMN(behind_nipple_mm),
    MAMMOTWIN_COLUMN(lateral_of_nipple_mm),
    MAMMOTWIN_COLUMN(above_nipple_mm),
    MAMMOTWIN_COLUMN(nipple_distance_mm),
    MAMMOTWIN_COLUMN(quadrant),
    MAMMOTWIN_COLUMN(clock),
    MAMMOTWIN_COLUMN(third),
};
#undef MAMMOTWIN_COLUMN

std::string formatted(std::optional<double> value) {
  if (!value) return "";
  char text[64];
  std::snprintf(text, sizeof text, "%.3f", std::round(*value * 1000) / 1000 + 0.0);
  return text;
}

std::string cell(const LesionRow& row, const Column& column) {
  if (const Text* text = std::get_if<Text>(&column.field)) return csv::quoted(row.*(*text));
  return formatted(row.*std::get<Number>(column.field));
}

LesionRow parse_row(const std::vector<std::string>& cells, const std::string& where) {
  if (cells.size() != kLesionColumns.size())
    throw std::runtime_error(where + " has " + std::to_string(cells.size()) + " cells; expected " +
                             std::to_string(kLesionColumns.size()));
  LesionRow row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (const Text* text = std::get_if<Text>(&kLesionColumns[i].field)) {
      row.*(*text) = cells[i];
    } else if (!cells[i].empty()) {
      row.*std::get<Number>(kLesionColumns[i].field) =
          csv::number(cells[i], where + ": column " + kLesionColumns[i].name);
    }
  }
  return row;
}

void check_header(const std::string& line, const std::string& file) {
  const std::vector<std::string> cells = csv::cells(line);
  for (std::size_t i = 0; i < kLesionColumns.size(); ++i)
    if (i >= cells.size() || cells[i] != kLesionColumns[i].name)
      throw std::runtime_error(file + ": column " + std::to_string(i + 1) + " is \"" +
                               (i < cells.size() ? cells[i] : "") + "\"; expected \"" +
                               kLesionColumns[i].name +
                               "\" (is this a lesions.csv of this version?)");
}

}  // namespace

void write_lesion_table(const std::filesystem::path& path, const std::vector<LesionRow>& rows) {
  std::ofstream out(path);
  for (const Column& column : kLesionColumns)
    out << (&column == kLesionColumns.data() ? "" : ",") << column.name;
  out << '\n';
  for (const LesionRow& row : rows) {
    for (const Column& column : kLesionColumns)
      out << (&column == kLesionColumns.data() ? "" : ",") << cell(row, column);
    out << '\n';
  }
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written; is the disk full?");
}

std::vector<LesionRow> read_lesion_table(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line))
    throw std::runtime_error(path.string() + ": cannot be read, or empty");
  check_header(line, path.string());
  std::vector<LesionRow> rows;
  for (int number = 2; std::getline(in, line); ++number)
    rows.push_back(parse_row(csv::cells(line), path.string() + ": line " + std::to_string(number)));
  return rows;
}

}  // namespace mammotwin
