#include "pipeline/report/lesion_data.h"

#include <cmath>

#include "pipeline/report/patient_results.h"
#include "pipeline/report/word.h"

namespace mammotwin {
namespace {

using Number = std::optional<double>;

std::string shown(const Number& value) { return value ? word::mm(*value) : ""; }

std::string shown(const Number& a, const Number& b, int decimals) {
  return a && b ? word::number(*a, decimals) + ", " + word::number(*b, decimals) : "";
}

std::string model_to_baseline(const LesionRow& row) {
  if (!row.detector_u_mm || !row.baseline_u_mm || !row.detector_v_mm || !row.baseline_v_mm)
    return "";
  return word::mm(
      std::hypot(*row.detector_u_mm - *row.baseline_u_mm, *row.detector_v_mm - *row.baseline_v_mm));
}

}  // namespace

nlohmann::json lesion_data(const std::vector<LesionRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const LesionRow& row : rows)
    list.push_back({{"lesion", row.lesion},
                    {"view", title_of_view(row.view)},
                    {"place", row.view != "mri"   ? ""
                              : row.clock.empty() ? row.quadrant
                                                  : row.quadrant + ", " + row.clock + " o'clock"},
                    {"behind", shown(row.behind_nipple_mm)},
                    {"lateral", shown(row.lateral_of_nipple_mm)},
                    {"above", shown(row.above_nipple_mm)},
                    {"distance", shown(row.nipple_distance_mm)},
                    {"detector", shown(row.detector_u_mm, row.detector_v_mm, 1)},
                    {"pixel", shown(row.pixel_column, row.pixel_row, 0) +
                                  (row.slice ? ", slice " + word::number(*row.slice, 0) : "")},
                    {"baseline", shown(row.baseline_u_mm, row.baseline_v_mm, 1)},
                    {"shift", model_to_baseline(row)}});
  return list;
}

}  // namespace mammotwin
