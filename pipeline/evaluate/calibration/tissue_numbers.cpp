#include "pipeline/evaluate/calibration/tissue_numbers.h"

#include <algorithm>
#include <stdexcept>

namespace mammotwin {

const std::vector<TissueNumber>& tissue_numbers() {
  using Settings = CompressionSettings;
  static const std::vector<TissueNumber> all{
      {"materials.stiffness_factor", "", 0.05, 2,
       [](const Settings& s) { return s.stiffness_factor; },
       [](Settings& s, double value) { s.stiffness_factor = value; }},
      {"materials.*.stiffening", "", 0.05, 10, [](const Settings& s) { return s.fat.stiffening; },
       [](Settings& s, double value) {
         s.fat.stiffening = s.fibroglandular.stiffening = s.lesion.stiffening = value;
       }},
      {"materials.*.most_stiffening", "", 2, 1e6,
       [](const Settings& s) { return s.fat.most_stiffening; },
       [](Settings& s, double value) {
         s.fat.most_stiffening = s.fibroglandular.most_stiffening = s.lesion.most_stiffening =
             value;
       }},
      {"materials.skin.c1_kpa", "kPa", 1, 100, [](const Settings& s) { return s.skin.c1; },
       [](Settings& s, double value) { s.skin.c1 = value; }},
      {"compress.chest_wall_spring_kpa_per_mm", "kPa/mm", 1e-4, 1,
       [](const Settings& s) { return s.boundary.chest_wall_spring; },
       [](Settings& s, double value) { s.boundary.chest_wall_spring = value; }},
      {"compress.cut_face_depth_mm", "mm", 5, 1000,
       [](const Settings& s) { return s.boundary.cut_face_depth; },
       [](Settings& s, double value) { s.boundary.cut_face_depth = value; }}};
  return all;
}

std::vector<TissueNumber> tissue_numbers(const std::vector<std::string>& keys) {
  std::vector<TissueNumber> asked;
  std::string known;
  for (const TissueNumber& number : tissue_numbers()) {
    known += (known.empty() ? "" : ", ") + number.key;
    if (std::find(keys.begin(), keys.end(), number.key) != keys.end()) asked.push_back(number);
  }
  for (const std::string& key : keys)
    if (std::none_of(asked.begin(), asked.end(), [&](const auto& n) { return n.key == key; }))
      throw std::runtime_error(key + " cannot be calibrated; expected some of " + known);
  return asked;
}

}  // namespace mammotwin
