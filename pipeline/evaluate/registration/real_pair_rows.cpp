#include "pipeline/evaluate/registration/real_pair_rows.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/frame/sidecar.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/view_header.h"
#include "registration/search/search_ellipse.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Half of the middle 90 and 50 % along one axis, in standard deviations: Student's 1.8125 and
/// 0.6998 for ten degrees of freedom (search_ellipse.h), times sqrt(8 / 10).
constexpr double kHalf90 = 1.6211, kHalf50 = 0.6259;

Eigen::Matrix2d covariance_of(const LesionRow& row) {
  if (!row.ellipse_major_mm || !row.detector_u_mm)
    throw std::runtime_error("lesions.csv has no ellipse for " + row.lesion + " in " + row.view +
                             "; it takes register.search = true");
  const double t = *row.ellipse_angle_deg * M_PI / 180;
  Eigen::Matrix2d axes;
  axes << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
  const Eigen::Vector2d sd =
      Eigen::Vector2d(*row.ellipse_major_mm, *row.ellipse_minor_mm) / semi_axis_in_sd(0.9);
  return axes * sd.cwiseAbs2().asDiagonal() * axes.transpose();
}

json place_figures(const Eigen::Vector2d& mark, const LesionRow& row,
                   const Eigen::Matrix2d& covariance) {
  const Eigen::Vector2d off = mark - Eigen::Vector2d(*row.detector_u_mm, *row.detector_v_mm);
  const Eigen::Vector2d baseline(*row.baseline_u_mm, *row.baseline_v_mm);
  return {{"judged", "place"},
          {"error_mm", off.norm()},
          {"baseline_error_mm", (mark - baseline).norm()},
          {"in_50", contains(search_ellipse(covariance, 0.5), off)},
          {"in_90", contains(search_ellipse(covariance, 0.9), off)},
          {"reach_90_mm", *row.ellipse_major_mm}};
}

json depth_figures(double depth_mm, const LesionRow& row, const Eigen::Matrix2d& covariance) {
  const double off = std::abs(depth_mm - *row.detector_u_mm), sd = std::sqrt(covariance(0, 0));
  return {{"judged", "depth"},
          {"error_mm", off},
          {"baseline_error_mm", std::abs(depth_mm - *row.baseline_u_mm)},
          {"in_50", off <= kHalf50 * sd},
          {"in_90", off <= kHalf90 * sd},
          {"reach_90_mm", kHalf90 * sd}};
}

/// How the search of a view ended, from register's sidecar.
std::string end_of(const fs::path& results, const std::string& view) {
  std::ifstream in(results / "lesions.csv.json");
  const json quality = in ? json::parse(in).value("quality", json::object()) : json::object();
  const json search = quality.value("search", json::object());
  return search.is_object() && search.contains(view)
             ? search[view].value("end", std::string("none"))
             : "none";
}

json mark_figures(const Patient& patient, const fs::path& results, const RealMark& mark,
                  const LesionRow& predicted) {
  const std::string vtu = mark.view + "_registered.vtu";
  const Side side = compressed_view(mark.view, vtu, read_mesh_file(results / vtu).metadata).side;
  std::vector<std::string> remarks;
  const Detector detector =
      with_header(patient, mark.view, side, remarks).detector(mark.view, side);
  if (const auto place = placed(mark, detector, side)) return judged_mark(mark, *place, predicted);
  return {{"reason", "nothing says how far a column is from the detector's edge"}};
}

std::string why_not_predicted(const fs::path& results, const RealMark& mark) {
  const auto reasons = reasons_of_failure(results / (mark.view + ".vtu"));
  return reasons.empty() ? "lesions.csv has no lesion " + mark.lesion
                         : "compress: " + reasons.front();
}

}  // namespace

json judged_mark(const RealMark& mark, const PlacedMark& place, const LesionRow& predicted) {
  const Eigen::Matrix2d covariance = covariance_of(predicted);
  json row = place.v_mm ? place_figures({place.u_mm, *place.v_mm}, predicted, covariance)
                        : depth_figures(place.u_mm, predicted, covariance);
  row["spacing"] = mark.assumed ? "assumed" : "known";
  row["depth_off_mm"] = place.u_mm - *predicted.detector_u_mm;
  return row;
}

json real_pair_rows(const fs::path& patient_folder, const fs::path& results) {
  Patient patient;
  patient.read(patient_folder / "patient.toml");
  const std::vector<LesionRow> table = read_lesion_table(results / "lesions.csv");
  json rows = json::array();
  for (const RealMark& mark : read_real_marks(patient_folder / "marks.csv")) {
    json row{{"case", patient_folder.filename().string()},
             {"lesion", mark.lesion},
             {"view", mark.view},
             {"end", end_of(results, mark.view)}};
    const auto predicted = std::find_if(table.begin(), table.end(), [&](const LesionRow& r) {
      return r.lesion == mark.lesion && r.view == mark.view;
    });
    if (predicted != table.end())
      row.update(mark_figures(patient, results, mark, *predicted));
    else
      row["reason"] = why_not_predicted(results, mark);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string real_pairs_summary(const json& cases) {
  std::string text = "mark less prediction; in the 50 and 90 % ellipse\n";
  for (const json& row : cases) {
    text += "  " + row.value("case", "") + " " + row.value("lesion", "") + " " +
            row.value("view", "") + ": ";
    if (!row.contains("error_mm")) {
      text += row.value("reason", std::string("not judged")) + "\n";
      continue;
    }
    char line[200];
    std::snprintf(line, sizeof line,
                  "%s off %.1f mm (depth %+.1f), baseline %.1f mm; %s, %s; reach %.1f mm; search "
                  "%s\n",
                  row["judged"].get<std::string>().c_str(), row["error_mm"].get<double>(),
                  row["depth_off_mm"].get<double>(), row["baseline_error_mm"].get<double>(),
                  row["in_50"].get<bool>() ? "in 50" : "out of 50",
                  row["in_90"].get<bool>() ? "in 90" : "out of 90",
                  row["reach_90_mm"].get<double>(), row["end"].get<std::string>().c_str());
    text += line;
  }
  return text;
}

}  // namespace mammotwin
