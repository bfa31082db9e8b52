#include "pipeline/evaluate/calibration/womens_moves.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

#include "pipeline/evaluate/compression/supine_points.h"
#include "registration/export/csv.h"

namespace mammotwin {
namespace {

struct Values {
  std::vector<double> values;
  std::set<std::string> women;

  PopulationFigure figure(const std::string& file) const {
    if (values.size() < 2) throw std::runtime_error(file + " has not two points of each kind");
    const double mean =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {middle_half(values).mean, std::sqrt(squares / static_cast<double>(values.size() - 1)),
            static_cast<int>(women.size())};
  }
};

/// A line of the file: lateral, posterior and along the body [mm].
struct PointRow {
  std::string woman, side;
  bool is_nipple = false;
  Eigen::Vector3d prone, supine;
  double prone_to_ribs = 0, supine_to_ribs = 0;  ///< [mm], of landmarks
};

std::vector<PointRow> read_rows(const std::filesystem::path& points_csv) {
  const std::string file = points_csv.string();
  std::ifstream in(points_csv);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(file + ": cannot be read, or empty");
  std::map<std::string, std::size_t> columns;
  for (const std::string& name : csv::cells(line)) columns.emplace(name, columns.size());
  for (const char* name :
       {"woman", "point", "side", "prone_l_mm", "prone_p_mm", "prone_s_mm", "supine_l_mm",
        "supine_p_mm", "supine_s_mm", "prone_to_ribs_mm", "supine_to_ribs_mm"})
    if (!columns.contains(name)) throw std::runtime_error(file + " has no column " + name);
  std::vector<PointRow> rows;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = csv::cells(line);
    const std::string where = file + ": line " + std::to_string(number);
    if (cells.size() != columns.size())
      throw std::runtime_error(where + " has " + std::to_string(cells.size()) +
                               " cells; expected " + std::to_string(columns.size()));
    const auto number_in = [&](const std::string& column) {
      return csv::number(cells[columns.at(column)], where + ": " + column);
    };
    PointRow row{cells[columns.at("woman")],
                 cells[columns.at("side")],
                 cells[columns.at("point")] == "nipple",
                 {},
                 {}};
    const double outward = row.side == "left" ? 1 : -1;
    const auto point = [&](const std::string& pose) {
      return Eigen::Vector3d(outward * number_in(pose + "_l_mm"), number_in(pose + "_p_mm"),
                             number_in(pose + "_s_mm"));
    };
    row.prone = point("prone");
    row.supine = point("supine");
    if (!row.is_nipple) {
      row.prone_to_ribs = number_in("prone_to_ribs_mm");
      row.supine_to_ribs = number_in("supine_to_ribs_mm");
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

MiddleHalf middle_half(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double n = static_cast<double>(values.size()), low = n / 4, high = 3 * n / 4;
  MiddleHalf half{0, std::vector<double>(values.size())};
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double begin = static_cast<double>(rank);
    const double inside = std::min(begin + 1, high) - std::max(begin, low);
    half.weights[order[rank]] = std::max(0.0, inside) / (high - low);
  }
  for (std::size_t i = 0; i < values.size(); ++i) half.mean += half.weights[i] * values[i];
  return half;
}

WomensMoves read_womens_moves(const std::filesystem::path& points_csv) {
  Values lateral, posterior, landmark, ribs;
  for (const PointRow& row : read_rows(points_csv)) {
    const auto add = [&](Values& values, double value) {
      values.values.push_back(value);
      values.women.insert(row.woman);
    };
    const Eigen::Vector3d way = row.supine - row.prone;
    if (row.is_nipple) {
      add(lateral, way.x());
      add(posterior, way.y());
    } else if (row.prone_to_ribs >= kNearestToRibs_mm &&
               row.prone_to_ribs <= kFarthestFromRibs_mm) {
      add(landmark, way.norm());
      add(ribs, row.supine_to_ribs);
    }
  }
  const std::string file = points_csv.string();
  return {lateral.figure(file), posterior.figure(file), landmark.figure(file), ribs.figure(file)};
}

std::vector<WomensLandmark> read_womens_landmarks(const std::filesystem::path& points_csv) {
  const std::vector<PointRow> rows = read_rows(points_csv);
  std::map<std::pair<std::string, std::string>, const PointRow*> nipples;
  for (const PointRow& row : rows)
    if (row.is_nipple) nipples[{row.woman, row.side}] = &row;
  std::vector<WomensLandmark> landmarks;
  for (const PointRow& row : rows) {
    const auto nipple = nipples.find({row.woman, row.side});
    if (row.is_nipple || nipple == nipples.end()) continue;
    landmarks.push_back(
        {row.woman, row.prone - nipple->second->prone, row.supine - nipple->second->supine});
  }
  return landmarks;
}

}  // namespace mammotwin
