#include "pipeline/patient/lesion_entry.h"

#include <string>

#include "segmentation/lesion/lesion_id.h"

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
  if (const std::string fault = fault_of_lesion_id(id); !fault.empty())
    throw BadSetting(where + ".id " + fault + "; expected a plain name such as \"L1\"");
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
