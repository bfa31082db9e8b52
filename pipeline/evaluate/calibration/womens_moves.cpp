#include "pipeline/evaluate/calibration/womens_moves.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

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
  const std::string file = points_csv.string();
  std::ifstream in(points_csv);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(file + ": cannot be read, or empty");
  std::map<std::string, std::size_t> columns;
  for (const std::string& name : csv::cells(line)) columns.emplace(name, columns.size());
  for (const char* name : {"woman", "point", "side", "prone_l_mm", "prone_p_mm", "prone_s_mm",
                           "supine_l_mm", "supine_p_mm", "supine_s_mm", "supine_to_ribs_mm"})
    if (!columns.contains(name)) throw std::runtime_error(file + " has no column " + name);
  Values lateral, posterior, landmark, ribs;
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
    Eigen::Vector3d way;
    for (int i = 0; i < 3; ++i) {
      const std::string axis = std::string("_") + "lps"[i] + "_mm";
      way[i] = number_in("supine" + axis) - number_in("prone" + axis);
    }
    const auto add = [&](Values& values, double value) {
      values.values.push_back(value);
      values.women.insert(cells[columns.at("woman")]);
    };
    if (cells[columns.at("point")] == "nipple") {
      add(lateral, cells[columns.at("side")] == "left" ? way.x() : -way.x());
      add(posterior, way.y());
    } else {
      add(landmark, way.norm());
      add(ribs, number_in("supine_to_ribs_mm"));
    }
  }
  return {lateral.figure(file), posterior.figure(file), landmark.figure(file), ribs.figure(file)};
}

}  // namespace mammotwin
