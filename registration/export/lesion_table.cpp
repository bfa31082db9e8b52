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
  const char* meaning;
};

#define MAMMOTWIN_COLUMN(name, meaning) \
  Column { #name, &LesionRow::name, meaning }
const std::array kLesionColumns = {
    MAMMOTWIN_COLUMN(patient, "name of the patient's folder, as text (042 is not 42)"),
    MAMMOTWIN_COLUMN(lesion, "name of the lesion, as text"),
    MAMMOTWIN_COLUMN(view, "`mri`: the prone MRI; `cc`, `mlo`: on that detector"),
    MAMMOTWIN_COLUMN(side, "`left` or `right`, the patient's"),
    MAMMOTWIN_COLUMN(volume_ml, "of the lesion in the MRI"),
    MAMMOTWIN_COLUMN(mri_l_mm, "lesion in the prone MRI, towards the patient's left"),
    MAMMOTWIN_COLUMN(mri_p_mm, "the same towards posterior"),
    MAMMOTWIN_COLUMN(mri_s_mm, "the same towards superior"),
    MAMMOTWIN_COLUMN(depth_mm, "in the view's frame, from the plates' edge towards the nipple"),
    MAMMOTWIN_COLUMN(lateral_mm,
                     "the same along the edge, towards lateral (CC) or superior-lateral (MLO)"),
    MAMMOTWIN_COLUMN(height_mm, "the same from the support towards the tube"),
    MAMMOTWIN_COLUMN(detector_u_mm, "on the detector, from its chest-wall edge"),
    MAMMOTWIN_COLUMN(
        detector_v_mm,
        "the same from the edge's middle, towards lateral (CC) or superior-lateral (MLO)"),
    MAMMOTWIN_COLUMN(pixel_column, "in the mammogram, from 0, where its spacing is known"),
    MAMMOTWIN_COLUMN(pixel_row, "the same"),
    MAMMOTWIN_COLUMN(slice, "of a tomosynthesis volume, from 1"),
    MAMMOTWIN_COLUMN(registration,
                     "with the view's mammogram: `ok`, `look`, `no registration` (place and "
                     "ellipse are those without it), `none` without a mammogram"),
    MAMMOTWIN_COLUMN(ellipse_major_mm,
                     "semi-axis of the ellipse that holds the lesion with 90 % probability if the "
                     "model is right"),
    MAMMOTWIN_COLUMN(ellipse_minor_mm, "the other semi-axis"),
    MAMMOTWIN_COLUMN(ellipse_angle_deg, "of the major axis, from u towards v"),
    MAMMOTWIN_COLUMN(picture_ellipse_major_mm,
                     "the same ellipse in the model's own picture, without a mammogram: turn and "
                     "shifts on the detector left out"),
    MAMMOTWIN_COLUMN(picture_ellipse_minor_mm, "the other semi-axis"),
    MAMMOTWIN_COLUMN(picture_ellipse_angle_deg, "of the major axis, from u towards v"),
    MAMMOTWIN_COLUMN(baseline_u_mm, "on the detector by the map without physics"),
    MAMMOTWIN_COLUMN(baseline_v_mm, "the same"),
    MAMMOTWIN_COLUMN(behind_nipple_mm, "`mri`: towards posterior; views: on the detector"),
    MAMMOTWIN_COLUMN(
        lateral_of_nipple_mm,
        "`mri`: along the patient's axis; views within 15 degrees of CC: on the detector"),
    MAMMOTWIN_COLUMN(above_nipple_mm,
                     "`mri`: along the patient's axis; other views: on the detector"),
    MAMMOTWIN_COLUMN(nipple_distance_mm, "`mri`: in space; views: on the detector"),
    MAMMOTWIN_COLUMN(
        quadrant, "in the MRI about the nipple: `upper outer`, ..., `central` within 10 mm of it"),
    MAMMOTWIN_COLUMN(
        clock,
        "in the MRI about the nipple, facing the patient: 3 is her left; empty where central"),
    MAMMOTWIN_COLUMN(third,
                     "of the breast's depth, from the nipple straight back to the muscle: "
                     "`anterior`, `middle`, `posterior`"),
    MAMMOTWIN_COLUMN(supine_skin_l_mm,
                     "`mri` rows: the skin straight above the lesion, the patient on her back, "
                     "towards her left, in the MRI's frame; not calibrated to her"),
    MAMMOTWIN_COLUMN(supine_skin_p_mm, "the same towards posterior"),
    MAMMOTWIN_COLUMN(supine_skin_s_mm, "the same towards superior"),
    MAMMOTWIN_COLUMN(supine_depth_mm, "of the lesion below that point"),
    MAMMOTWIN_COLUMN(supine_from_nipple_mm, "of that point, straight"),
    MAMMOTWIN_COLUMN(supine_clock, "of that point about the nipple, facing the patient"),
    MAMMOTWIN_COLUMN(supine_semi_l_mm,
                     "semi-axis to the side of the ellipsoid that holds the lesion with 90 %, seen "
                     "from the nipple, the patient on her back"),
    MAMMOTWIN_COLUMN(supine_semi_p_mm, "the same, from front to back"),
    MAMMOTWIN_COLUMN(supine_semi_s_mm, "the same, along the body"),
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

/// As the column's name says it.
std::string unit_of(const Column& column) {
  if (std::holds_alternative<Text>(column.field)) return "text";
  const std::string name = column.name;
  if (name.starts_with("pixel_")) return "pixel";
  const std::size_t unit = name.rfind('_');
  return unit == std::string::npos ? "-" : name.substr(unit + 1);
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

void write_lesion_dictionary(const std::filesystem::path& path) {
  std::ofstream out(path);
  out << "# The columns of lesions.csv\n\nA lesion has one row for the prone MRI and one for each "
         "view. "
         "What is not known is empty.\n\n| column | unit | meaning |\n|---|---|---|\n";
  for (const Column& column : kLesionColumns)
    out << "| `" << column.name << "` | " << unit_of(column) << " | " << column.meaning << " |\n";
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
