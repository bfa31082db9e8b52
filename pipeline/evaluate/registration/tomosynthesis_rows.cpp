#include "pipeline/evaluate/registration/tomosynthesis_rows.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "registration/export/landmark_table.h"
#include "registration/export/lesion_table.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json parsed(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  return json::parse(in);
}

/// Across the slice [mm]; null where the lesion has no mark.
json across_mm(const LesionRow& row, const std::vector<LandmarkPair>& pairs, double pixel_mm) {
  for (const LandmarkPair& pair : pairs)
    if (pair.name == row.lesion && row.pixel_column && row.pixel_row)
      return (Eigen::Vector2d(*row.pixel_column, *row.pixel_row) - pair.marks.at(row.view)).norm() *
             pixel_mm;
  return nullptr;
}

}  // namespace

json tomosynthesis_rows(const std::filesystem::path& folder) {
  const json truth = parsed(folder / "slices.json");
  const std::vector<LandmarkPair> pairs = read_landmark_pairs(folder / "landmarks.csv");
  json rows = json::array();
  for (const LesionRow& row : read_lesion_table(folder / "lesions.csv")) {
    if (!row.slice) continue;
    const double slice = truth.at(row.view).at(row.lesion);
    rows.push_back(
        {{"name", row.lesion},
         {"view", row.view},
         {"slice", *row.slice},
         {"slice_true", slice},
         {"slice_mm", std::abs(*row.slice - slice) * truth.at("spacing_mm").get<double>()},
         {"mark_mm", across_mm(row, pairs, truth.at("pixel_mm"))}});
  }
  return rows;
}

}  // namespace mammotwin
