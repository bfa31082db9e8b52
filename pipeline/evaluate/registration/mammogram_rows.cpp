#include "pipeline/evaluate/registration/mammogram_rows.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "pipeline/evaluate/registration/line_distance.h"
#include "pipeline/evaluate/registration/mammogram_changes.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Line = std::vector<Eigen::Vector2d>;

// Right is: [mm]
constexpr double kBesideNipple_mm = 25;
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

/// The line's farthest column in a row that it reaches.
std::optional<double> deepest_at(double row, const Line& line) {
  std::optional<double> deepest;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const Eigen::Vector2d &a = line[n - 1], &b = line[n];
    if ((a.y() - row) * (b.y() - row) > 0 || a.y() == b.y()) continue;
    const double column = a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    deepest = std::max(deepest.value_or(column), column);
  }
  return deepest;
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

bool doubted(const MammogramImage& image, double pixel_mm, bool oblique) {
  try {
    return !find_breast(image, pixel_mm, oblique).view_doubt.empty();
  } catch (const std::runtime_error&) {
    return true;
  }
}

}  // namespace

json noticed_row(const ReadMammogram& read, const MammogramImage& image) {
  const bool oblique = read.oblique();
  json row{{"other_view_noticed", doubted(image, read.pixel_mm, !oblique)}};
  if (oblique) row["upside_down_noticed"] = doubted(upside_down(image), read.pixel_mm, oblique);
  return row;
}

json mammogram_row(const ReadMammogram& read, const MammogramFindings& found) {
  json row{{"outline_worst_mm", nullptr},
           {"nipple_mm", nullptr},
           {"nipple_sd_mm", found.nipple_sd_mm},
           {"nipple_evidence", name_of(found.evidence)},
           {"pectoral_worst_mm", nullptr},
           {"pectoral_sd_mm", nullptr},
           {"unsure", found.unsure},
           {"view_doubted", !found.view_doubt.empty()},
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

json positioning_row(const ReadMammogram& read, Line outline, int columns) {
  if (!read.pectoral || !read.nipple) return json::object();
  const auto from_edge = [&](Eigen::Vector2d pixel) {
    if (!read.wall_at_left) pixel.x() = columns - 1 - pixel.x();
    return pixel;
  };
  std::transform(outline.begin(), outline.end(), outline.begin(), from_edge);
  const Eigen::Vector2d top = from_edge(read.pectoral->first),
                        bottom = from_edge(read.pectoral->second), nipple = from_edge(*read.nipple);
  const auto degrees = [](double deeper, double up) {
    return std::atan2(deeper, up) * 180 / std::numbers::pi;
  };
  json row{{"muscle_slope_deg", degrees(top.x() - bottom.x(), bottom.y() - top.y())},
           {"nipple_share", nipple.x() / distance_to_line(nipple, {top, bottom}, true)},
           {"skin_slope_deg", nullptr}};
  const double aside = kBesideNipple_mm / read.pixel_mm;
  const std::optional<double> above = deepest_at(nipple.y() - aside, outline),
                              below = deepest_at(nipple.y() + aside, outline);
  if (above && below) row["skin_slope_deg"] = degrees(*above - *below, 2 * aside);
  return row;
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
