#include "pipeline/evaluate/registration/mammogram_rows.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pipeline/evaluate/registration/line_distance.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Line = std::vector<Eigen::Vector2d>;

// Right is: [mm]
constexpr double kSkin_mm = 3, kNipple_mm = 5, kFarNipple_mm = 10, kPectoral_mm = 5;

double worst(const Line& points, const Line& line, bool endless, double pixel_mm) {
  double most = 0;
  for (const Eigen::Vector2d& x : points)
    most = std::max(most, distance_to_line(x, line, endless) * pixel_mm);
  return most;
}

bool unsure(const json& row, const char* what) {
  const json& said = row.at("unsure");
  return std::find(said.begin(), said.end(), what) != said.end();
}

/// Rows in which a figure is known, right, wrong but said to be unsure, and wrong all the same.
json counted(const json& rows, const char* figure, const char* what, double limit) {
  int known = 0, right = 0, said = 0, wrong = 0;
  for (const json& row : rows) {
    if (!row.contains(figure) || row[figure].is_null()) continue;
    ++known;
    const bool good = row[figure].get<double>() <= limit;
    right += good;
    said += !good && unsure(row, what);
    wrong += !good && !unsure(row, what);
  }
  return {{"known", known},
          {"right", right},
          {"wrong_but_unsure", said},
          {"wrong_and_sure", wrong},
          {"limit_mm", limit}};
}

/// What errors are in standard deviations: root of the mean square, and how many are within one and
/// two; of those that are sure.
json calibration(const json& rows, const char* figure, const char* sd, const char* what) {
  int known = 0, within = 0, within_two = 0;
  double squares = 0;
  for (const json& row : rows) {
    if (!row.contains(figure) || row[figure].is_null() || row[sd].is_null() || unsure(row, what))
      continue;
    const double z = row[figure].get<double>() / row[sd].get<double>();
    ++known;
    within += z <= 1;
    within_two += z <= 2;
    squares += z * z;
  }
  return {{"known", known},
          {"within_1", within},
          {"within_2", within_two},
          {"rms", known > 0 ? json(std::sqrt(squares / known)) : json()}};
}

}  // namespace

json mammogram_row(const ReadMammogram& read, const MammogramFindings& found) {
  json row{{"outline_worst_mm", nullptr},
           {"nipple_mm", nullptr},
           {"nipple_sd_mm", found.nipple_sd_mm},
           {"nipple_evidence", name_of(found.evidence)},
           {"pectoral_worst_mm", nullptr},
           {"pectoral_sd_mm", nullptr},
           {"unsure", found.unsure},
           {"remarks", found.remarks}};
  if (!read.skin.empty())
    row["outline_worst_mm"] = worst(read.skin, found.outline, false, read.pixel_mm);
  if (read.nipple) row["nipple_mm"] = (*read.nipple - found.nipple).norm() * read.pixel_mm;
  if (found.pectoral) row["pectoral_sd_mm"] = found.pectoral_sd_mm;
  if (read.pectoral && found.pectoral)
    row["pectoral_worst_mm"] = worst({read.pectoral->first, read.pectoral->second},
                                     coarse(found.pectoral_curve), true, read.pixel_mm);
  return row;
}

json positioning_row(const ReadMammogram& read, int columns) {
  if (!read.pectoral || !read.nipple) return json::object();
  const auto from_edge = [&](Eigen::Vector2d pixel) {
    if (!read.wall_at_left) pixel.x() = columns - 1 - pixel.x();
    return pixel;
  };
  const Eigen::Vector2d top = from_edge(read.pectoral->first),
                        bottom = from_edge(read.pectoral->second), nipple = from_edge(*read.nipple);
  const Eigen::Vector2d up = top - bottom;
  return {{"muscle_slope_deg", std::atan2(up.x(), -up.y()) * 180 / std::numbers::pi},
          {"nipple_share", nipple.x() / distance_to_line(nipple, {top, bottom}, true)}};
}

json mammogram_counts(const json& rows) {
  int refused = 0, far = 0;
  for (const json& row : rows) {
    refused += row.contains("refused");
    far += row.contains("nipple_mm") && !row["nipple_mm"].is_null() &&
           row["nipple_mm"].get<double>() > kFarNipple_mm && !unsure(row, "nipple");
  }
  return {
      {"images", rows.size()},
      {"refused", refused},
      {"outline", counted(rows, "outline_worst_mm", "outline", kSkin_mm)},
      {"nipple", counted(rows, "nipple_mm", "nipple", kNipple_mm)},
      {"nipple_sure_beyond_10_mm", far},
      {"pectoral", counted(rows, "pectoral_worst_mm", "pectoral", kPectoral_mm)},
      {"nipple_over_sd", calibration(rows, "nipple_mm", "nipple_sd_mm", "nipple")},
      {"pectoral_over_sd", calibration(rows, "pectoral_worst_mm", "pectoral_sd_mm", "pectoral")}};
}

void commit_counted(const json& counts, const json& cases, Products& products) {
  write_text_atomically(products.write_main(),
                        json{{"counts", counts}, {"cases", cases}}.dump(1) + "\n");
  products.commit();
  std::cout << counts.dump(1) << std::endl;
}

}  // namespace mammotwin
