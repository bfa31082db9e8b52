#include "registration/export/landmark_table.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "registration/export/csv.h"

namespace mammotwin {
namespace {

constexpr std::array kLandmarkColumns = {"name",      "mri_l_mm", "mri_p_mm",   "mri_s_mm",
                                         "cc_column", "cc_row",   "mlo_column", "mlo_row"};

/// The numbers of neighbouring cells, if all are there. Throws if only some are.
template <int n>
std::optional<Eigen::Matrix<double, n, 1>> numbers(const std::vector<std::string>& cells, int first,
                                                   const std::string& where) {
  Eigen::Matrix<double, n, 1> values = Eigen::Matrix<double, n, 1>::Zero();
  int filled = 0;
  for (int i = 0; i < n; ++i)
    if (!cells[first + i].empty()) {
      values[i] = csv::number(cells[first + i], where + ": " + kLandmarkColumns[first + i]);
      ++filled;
    }
  if (filled == 0) return std::nullopt;
  if (filled != n)
    throw std::runtime_error(where + ": " + kLandmarkColumns[first] +
                             " and its neighbours are only partly filled; expected all or none");
  return values;
}

LandmarkPair parse_pair(const std::vector<std::string>& cells, const std::string& where) {
  if (cells.size() != kLandmarkColumns.size())
    throw std::runtime_error(where + " has " + std::to_string(cells.size()) + " cells; expected " +
                             std::to_string(kLandmarkColumns.size()));
  LandmarkPair pair;
  pair.name = cells[0];
  pair.mri_in_lps = numbers<3>(cells, 1, where);
  if (const auto mark = numbers<2>(cells, 4, where)) pair.marks["cc"] = *mark;
  if (const auto mark = numbers<2>(cells, 6, where)) pair.marks["mlo"] = *mark;
  return pair;
}

void judge_view(const LandmarkPair& pair, const std::string& name, const JudgedView& view,
                TargetErrors& errors) {
  const auto mark = pair.marks.find(name);
  if (!pair.mri_in_lps || mark == pair.marks.end()) return;
  const ProjectedLandmark predicted = view.projection->project({pair.name, *pair.mri_in_lps});
  const Eigen::Vector2d truth = view.projection->detector().detector_from_image(mark->second);
  errors.with_model.push_back((predicted.on_detector - truth).norm());
  errors.without_model.push_back((predicted.baseline_on_detector - truth).norm());
}

/// The ray to a mark, taken to the prone breast by the baseline: a straight line.
Eigen::ParametrizedLine<double, 3> baseline_line(const JudgedView& view,
                                                 const Eigen::Vector2d& uv) {
  const auto at = [&](double height) {
    return view.projection->baseline().prone_from_view(
        view.projection->detector().point_on_ray(uv, height));
  };
  return Eigen::ParametrizedLine<double, 3>::Through(at(0), at(1));
}

Eigen::Vector3d midway(const Eigen::ParametrizedLine<double, 3>& a,
                       const Eigen::ParametrizedLine<double, 3>& b) {
  Eigen::Matrix<double, 3, 2> directions;
  directions << a.direction(), -b.direction();
  const Eigen::Vector2d t = (directions.transpose() * directions).inverse() *
                            (directions.transpose() * (b.origin() - a.origin()));
  return (a.pointAt(t.x()) + b.pointAt(t.y())) / 2;
}

void judge_space(const LandmarkPair& pair, const std::map<std::string, JudgedView>& views,
                 TargetErrors& errors) {
  const auto cc = views.find("cc"), mlo = views.find("mlo");
  if (!pair.mri_in_lps || pair.marks.size() < 2 || cc == views.end() || mlo == views.end()) return;
  const auto on_detector = [&](const JudgedView& view, const std::string& name) {
    return view.projection->detector().detector_from_image(pair.marks.at(name));
  };
  const Eigen::Vector2d a = on_detector(cc->second, "cc"), b = on_detector(mlo->second, "mlo");
  if (const auto found = closest_approach(*cc->second.rays, a, *mlo->second.rays, b))
    errors.with_model.push_back((found->prone_in_lps - *pair.mri_in_lps).norm());
  errors.without_model.push_back(
      (midway(baseline_line(cc->second, a), baseline_line(mlo->second, b)) - *pair.mri_in_lps)
          .norm());
}

double quantile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  const double at = fraction * (values.size() - 1);
  const std::size_t low = static_cast<std::size_t>(at);
  const double next = values[std::min(low + 1, values.size() - 1)];
  return values[low] + (at - low) * (next - values[low]);
}

std::string line(const std::string& view, const char* prediction,
                 const std::vector<double>& errors) {
  char text[160];
  const double n = static_cast<double>(errors.size());
  if (errors.empty()) {
    std::snprintf(text, sizeof text, "%-5s %-14s %8s\n", view.c_str(), prediction, "no pairs");
    return text;
  }
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
  double squares = 0;
  for (const double e : errors) squares += (e - mean) * (e - mean);
  std::snprintf(text, sizeof text, "%-5s %-14s %8.2f %8.2f %8.2f %8.2f %6zu\n", view.c_str(),
                prediction, mean, n > 1 ? std::sqrt(squares / (n - 1)) : 0.0, quantile(errors, 0.5),
                quantile(errors, 0.95), errors.size());
  return text;
}

}  // namespace

std::vector<LandmarkPair> read_landmark_pairs(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string text;
  if (!std::getline(in, text))
    throw std::runtime_error(path.string() + ": cannot be read, or empty");
  const std::vector<std::string> header = csv::cells(text);
  if (!std::equal(header.begin(), header.end(), kLandmarkColumns.begin(), kLandmarkColumns.end()))
    throw std::runtime_error(path.string() + ": the first line is \"" + text +
                             "\"; expected name,mri_l_mm,mri_p_mm,mri_s_mm,cc_column,cc_row,"
                             "mlo_column,mlo_row");
  std::vector<LandmarkPair> pairs;
  for (int number = 2; std::getline(in, text); ++number)
    pairs.push_back(
        parse_pair(csv::cells(text), path.string() + ": line " + std::to_string(number)));
  return pairs;
}

std::map<std::string, TargetErrors> target_errors(const std::vector<LandmarkPair>& pairs,
                                                  const std::map<std::string, JudgedView>& views) {
  std::map<std::string, TargetErrors> errors;
  for (const LandmarkPair& pair : pairs) {
    for (const auto& [name, view] : views) judge_view(pair, name, view, errors[name]);
    judge_space(pair, views, errors["3d"]);
  }
  return errors;
}

std::string target_error_table(const std::map<std::string, TargetErrors>& errors) {
  std::string table = "view  prediction       mean [mm]  SD   median      p95      n\n";
  for (const auto& [view, error] : errors) {
    table += line(view, "model", error.with_model);
    table += line(view, "without model", error.without_model);
  }
  return table;
}

}  // namespace mammotwin
