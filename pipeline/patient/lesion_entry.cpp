#include "pipeline/patient/lesion_entry.h"

#include <string>

namespace mammotwin {
void declare_lesion(Settings& settings, const std::string& prefix, LesionEntry& entry) {
  settings.text(prefix + "id", entry.id, "name in every table; default L1, L2, ...");
  settings.point(prefix + "point_lps_mm", entry.point_lps_mm, {-kFarthestMm, kFarthestMm, "mm"},
                 "a point in the lesion, patient LPS; its extent is found in the image");
  settings.number(prefix + "radius_mm", entry.radius_mm, {1, 60, "mm"},
                  "makes the lesion a sphere around the point");
  settings.path(prefix + "markups", entry.markups,
                "3D Slicer markups (.mrk.json, LPS or RAS): its first point");
  settings.path(prefix + "labels", entry.labels, "label map in which the lesion is drawn");
  settings.integer(prefix + "label", entry.label, {1, 65535}, "value of the lesion in `labels`");
}

void require_plain_id(const std::string& where, const std::string& id) {
  const auto refuse = [&](const std::string& found) {
    throw BadSetting(where + ".id " + found + "; expected a plain name such as \"L1\"");
  };
  constexpr std::size_t most_bytes = 64;  // more has no place in a table or a file's label
  if (id.size() > most_bytes) refuse("is longer than 64 bytes");
  for (const unsigned char c : id)
    if (c < ' ' || c == 127) refuse("holds a control character (a newline, a tab)");
  // UTF-8 of U+200E to U+200F, U+202A to U+202E and U+2066 to U+2069
  for (const char* mark : {"\u200e", "\u200f", "\u202a", "\u202b", "\u202c", "\u202d", "\u202e",
                           "\u2066", "\u2067", "\u2068", "\u2069"})
    if (id.find(mark) != std::string::npos) refuse("holds a mark that turns the text's direction");
  if (std::string("=+-@").find(id.front()) != std::string::npos)
    refuse("begins with a character that makes it a formula in a spreadsheet");
}

void require_one_place(const std::string& where, const LesionEntry& entry) {
  const int places =
      entry.point_lps_mm.has_value() + entry.markups.has_value() + entry.labels.has_value();
  if (places != 1)
    throw BadSetting(where + " says in " + std::to_string(places) +
                     " ways where the lesion is; expected one of point_lps_mm, markups, labels");
  if (entry.radius_mm && entry.labels)
    throw BadSetting(where + " has both labels and radius_mm; a radius goes with a point");
}

}  // namespace mammotwin
