#include "pipeline/report/answer_data.h"

#include <cmath>

#include "pipeline/report/word.h"
#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Number = std::optional<double>;

std::string whole_mm(double mm) { return word::number(std::abs(mm), 0) + " mm"; }

/// "left breast, lower inner, 7 o'clock, middle third, 45 mm from the nipple, 0.8 ml".
std::string place_words(const LesionRow& row) {
  std::string words = row.side.empty() ? "" : row.side + " breast, ";
  words += row.quadrant;
  if (!row.clock.empty()) words += ", " + row.clock + " o'clock";
  if (!row.third.empty()) words += ", " + row.third + " third";
  if (row.nipple_distance_mm)
    words += ", " + whole_mm(*row.nipple_distance_mm) + " from the nipple";
  if (row.volume_ml) words += ", " + word::number(*row.volume_ml, 1) + " ml";
  return words;
}

/// "36 mm behind the nipple, 31 mm medial".
std::string view_words(const LesionRow& row) {
  if (!row.behind_nipple_mm) return "";
  std::string words = whole_mm(*row.behind_nipple_mm) +
                      (*row.behind_nipple_mm < 0 ? " in front of" : " behind") + " the nipple";
  if (const Number& lateral = row.lateral_of_nipple_mm)
    words += ", " + whole_mm(*lateral) + (*lateral < 0 ? " medial" : " lateral");
  if (const Number& above = row.above_nipple_mm)
    words += ", " + whole_mm(*above) + (*above < 0 ? " below" : " above");
  if (row.detector_u_mm && *row.detector_u_mm < 0)
    words += "; predicted behind the detector's edge, where a mammogram may not show it";
  return words;
}

std::string axes(double major, double minor) {
  return word::number(major, 0) + " × " + word::number(minor, 0) + " mm";
}

/// "skin at 8 o'clock, 52 mm from the nipple; the lesion 23 mm below it"; empty without a state.
std::string supine_words(const LesionRow& row) {
  if (!row.supine_depth_mm || !row.supine_from_nipple_mm) return "";
  std::string words = "skin ";
  if (!row.supine_clock.empty()) words += "at " + row.supine_clock + " o'clock, ";
  return words + whole_mm(*row.supine_from_nipple_mm) + " from the nipple; the lesion " +
         whole_mm(*row.supine_depth_mm) + " straight below it" +
         (row.supine_semi_l_mm
              ? "; 90 %: within " + whole_mm(*row.supine_semi_l_mm) + " to the sides, " +
                    whole_mm(*row.supine_semi_p_mm) + " in depth and " +
                    whole_mm(*row.supine_semi_s_mm) + " along the body, seen from the nipple"
              : "");
}

/// "Do not believe it: the model goes 247 mm from prone to supine ..."; empty where it may be.
std::string supine_doubt(const json* unloaded) {
  if (!unloaded || !unloaded->contains("quality")) return "";
  const double move_mm = unloaded->at("quality").value("supine_move_max_mm", 0.0);
  if (move_mm <= limits::pose_move_mm) return "";
  return "Do not believe it: the model goes " + whole_mm(move_mm) +
         " from prone to supine, 95 % of women's nipples 172 mm at most";
}

/// "Pressed to 56 mm, where the paddle presses with 144 N: nobody says how thick the breast
/// became"; empty where somebody does.
std::string thickness_words(const json* sidecar) {
  if (!sidecar || !sidecar->contains("quality")) return "";
  const json& quality = sidecar->at("quality");
  if (!quality.value("thickness_assumed", false)) return "";
  const bool by_force = quality.value("stopped_by_force", false);
  return "Pressed to " + whole_mm(quality.value("thickness_mm", 0.0)) +
         (by_force ? ", where the paddle presses with " +
                         word::number(quality.value("force_N", 0.0), 0) + " N"
                   : ", which is typical of such a volume") +
         ": nobody says how thick the breast became";
}

json view_entry(const LesionRow& row, const PatientResults& results) {
  std::string search, full;
  if (row.picture_ellipse_major_mm) {
    search = "Search within " + axes(*row.picture_ellipse_major_mm, *row.picture_ellipse_minor_mm) +
             " of it in the simulated view";
    full = "; no mammogram was registered, so on a real one within " +
           axes(*row.ellipse_major_mm, *row.ellipse_minor_mm);
  } else if (row.ellipse_major_mm) {
    search = "Search within " + axes(*row.ellipse_major_mm, *row.ellipse_minor_mm) + " of it";
  }
  return {{"view", title_of_view(row.view)},
          {"where", view_words(row)},
          {"search", search},
          {"full", full},
          {"not_registered", results.not_registered(row.view)},
          {"in_doubt", results.registered_in_doubt(row.view)},
          {"thickness", thickness_words(results.sidecar(row.view + ".vtu"))}};
}

}  // namespace

json answer_data(const PatientResults& results) {
  json lesions = json::array();
  for (const LesionRow& mri : results.rows) {
    if (mri.view != "mri") continue;
    json views = json::array();
    for (const LesionRow& row : results.rows)
      if (row.lesion == mri.lesion && row.view != "mri") views.push_back(view_entry(row, results));
    lesions.push_back({{"lesion", mri.lesion},
                       {"place", place_words(mri)},
                       {"views", views},
                       {"supine", supine_words(mri)},
                       {"supine_doubt", supine_doubt(results.sidecar("unloaded.vtu"))}});
  }
  return lesions;
}

}  // namespace mammotwin
