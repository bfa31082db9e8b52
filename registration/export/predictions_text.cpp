#include "registration/export/predictions_text.h"

#include <cctype>
#include <cstdio>

namespace mammotwin {
namespace {

std::string upper(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string number(const std::optional<double>& value) {
  if (!value) return "?";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", *value);
  return text;
}

std::string padded(std::string text, std::size_t width) {
  return text.size() < width ? text + std::string(width - text.size(), ' ') : text;
}

std::string line_of(const LesionRow& row) {
  std::string line = "  " + padded(row.lesion, 8) + " " + padded(upper(row.view), 4) + " depth " +
                     number(row.depth_mm) + "  lateral " + number(row.lateral_mm) + "  height " +
                     number(row.height_mm) + "  on the detector (" + number(row.detector_u_mm) +
                     ", " + number(row.detector_v_mm) + ")";
  if (row.slice) line += "  slice " + number(row.slice);
  if (row.ellipse_major_mm)
    line += "  90 % ellipse " + number(row.ellipse_major_mm) + " x " + number(row.ellipse_minor_mm);
  if (row.registration == "look" || row.registration == "no registration")
    line += "  " + row.registration;
  return line + "\n";
}

}  // namespace

std::string predictions_text(const std::vector<LesionRow>& rows) {
  std::string text;
  for (const LesionRow& row : rows)
    if (row.view != "mri") text += line_of(row);
  if (text.empty()) return text;
  return "Predicted lesion positions [mm]: from the detector's chest-wall edge, its middle, the "
         "support; semi-axes of the ellipse\n" +
         text;
}

}  // namespace mammotwin
