#include "segmentation/files/markups.h"

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

namespace mammotwin {

namespace {

using nlohmann::json;

/// What `take` makes of the file's markups; what it throws is said of the file.
template <class Take>
auto read_file(const std::filesystem::path& path, const Take& take) {
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error(path.string() +
                             ": does not exist; expected a 3D Slicer markups file (.mrk.json)");
  try {
    return take(json::parse(file).at("markups"));
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() +
                             ": not a readable 3D Slicer markups file: " + error.what());
  }
}

/// Signs that bring a markup's coordinates to LPS.
Eigen::Vector3d lps_from(const json& markup) {
  const std::string units = markup.value("coordinateUnits", "mm");
  if (units != "mm")
    throw std::runtime_error("markups.coordinateUnits is \"" + units + "\"; expected mm");
  const std::string system = markup.value("coordinateSystem", "LPS");
  if (system == "LPS" || system == "0") return {1, 1, 1};
  if (system == "RAS" || system == "1") return {-1, -1, 1};
  throw std::runtime_error("markups.coordinateSystem is \"" + system + "\"; expected LPS or RAS");
}

Eigen::Vector3d three_numbers(const json& list, const std::string& what) {
  const auto numbers = list.get<std::vector<double>>();
  if (numbers.size() != 3)
    throw std::runtime_error(what + " has " + std::to_string(numbers.size()) +
                             " numbers; expected 3");
  return Eigen::Vector3d(numbers.data());
}

void append_points(const json& markup, std::vector<MarkupPoint>& points) {
  const Eigen::Vector3d signs = lps_from(markup);
  for (const json& point : markup.at("controlPoints")) {
    if (point.value("positionStatus", "defined") != "defined") continue;
    points.push_back(
        {point.value("label", ""),
         signs.cwiseProduct(three_numbers(point.at("position"), "a control point's position")),
         point.value("description", "")});
  }
}

/// Do the columns of a rotation run along the axes, each along its own?
bool runs_along_axes(const json& orientation) {
  const double least = std::cos(std::numbers::pi / 180);
  const auto matrix = orientation.get<std::array<double, 9>>();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(matrix[4 * axis]) < least) return false;
  return true;
}

}  // namespace

std::vector<MarkupPoint> read_markups(const std::filesystem::path& path) {
  return read_file(path, [](const json& markups) {
    std::vector<MarkupPoint> points;
    for (const json& markup : markups) append_points(markup, points);
    if (points.empty()) throw std::runtime_error("it holds no control point; expected some");
    return points;
  });
}

Eigen::Vector3d read_markups_point(const std::filesystem::path& path) {
  return read_markups(path).front().x_in_lps;
}

std::vector<Eigen::Vector3d> read_markups_points(const std::filesystem::path& path) {
  std::vector<Eigen::Vector3d> places;
  for (const MarkupPoint& point : read_markups(path)) places.push_back(point.x_in_lps);
  return places;
}

Eigen::AlignedBox3d read_markups_box(const std::filesystem::path& path) {
  return read_file(path, [](const json& markups) {
    const json& roi = markups.at(0);
    if (!roi.contains("center") || !roi.contains("size"))
      throw std::runtime_error("it holds no ROI; expected one");
    if (!runs_along_axes(roi.at("orientation")))
      throw std::runtime_error("the ROI is turned; expected sides along the patient's axes");
    const Eigen::Vector3d centre =
        lps_from(roi).cwiseProduct(three_numbers(roi.at("center"), "the ROI's center"));
    const Eigen::Vector3d half = three_numbers(roi.at("size"), "the ROI's size").cwiseAbs() / 2;
    if (half.minCoeff() <= 0) throw std::runtime_error("the ROI is flat; expected a box");
    return Eigen::AlignedBox3d((centre - half).eval(), (centre + half).eval());
  });
}

}  // namespace mammotwin
