#include "registration/export/markups.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr const char* kSchema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

nlohmann::ordered_json control_point(const MarkupPoint& point, std::size_t number) {
  return {{"id", std::to_string(number)},
          {"label", point.label},
          {"description", point.description},
          {"associatedNodeID", ""},
          {"position", {point.x_in_lps.x(), point.x_in_lps.y(), point.x_in_lps.z()}},
          {"orientation", {-1.0, -0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0}},
          {"selected", true},
          {"locked", false},
          {"visibility", true},
          {"positionStatus", "defined"}};
}

/// Signs that bring the file's coordinates to LPS.
Eigen::Vector3d lps_from(const nlohmann::json& markup) {
  const std::string system = markup.value("coordinateSystem", "LPS");
  if (system == "LPS" || system == "0") return {1, 1, 1};
  if (system == "RAS" || system == "1") return {-1, -1, 1};
  throw std::runtime_error("markups.coordinateSystem is \"" + system + "\"; expected LPS or RAS");
}

void append_points(const nlohmann::json& markup, std::vector<MarkupPoint>& points) {
  const std::string units = markup.value("coordinateUnits", "mm");
  if (units != "mm")
    throw std::runtime_error("markups.coordinateUnits is \"" + units + "\"; expected mm");
  const Eigen::Vector3d signs = lps_from(markup);
  for (const nlohmann::json& point : markup.at("controlPoints")) {
    if (point.value("positionStatus", "defined") != "defined") continue;
    const auto position = point.at("position").get<std::vector<double>>();
    if (position.size() != 3)
      throw std::runtime_error("a control point's position has " + std::to_string(position.size()) +
                               " numbers; expected 3");
    points.push_back({point.value("label", ""),
                      signs.cwiseProduct(Eigen::Vector3d(position.data())),
                      point.value("description", "")});
  }
}

nlohmann::ordered_json markup(const std::string& type, const std::string& name,
                              const std::vector<MarkupPoint>& points) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MarkupPoint& point : points) list.push_back(control_point(point, list.size() + 1));
  nlohmann::ordered_json markup = {
      {"type", type},    {"coordinateSystem", "LPS"}, {"coordinateUnits", "mm"},
      {"locked", false}, {"labelFormat", "%N-%d"},    {"controlPoints", list}};
  if (!name.empty()) markup["name"] = name;
  return markup;
}

void write_file(const std::filesystem::path& path, const nlohmann::ordered_json& markup) {
  const nlohmann::ordered_json file = {{"@schema", kSchema},
                                       {"markups", nlohmann::ordered_json::array({markup})}};
  std::ofstream out(path);
  out << file.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written; is the disk full?");
}

}  // namespace

void write_markups(const std::filesystem::path& path, const std::vector<MarkupPoint>& points) {
  write_file(path, markup("Fiducial", "", points));
}

void write_closed_curve(const std::filesystem::path& path, const std::string& name,
                        const std::vector<Eigen::Vector3d>& in_lps) {
  std::vector<MarkupPoint> points;
  for (const Eigen::Vector3d& x : in_lps) points.push_back({"", x});
  write_file(path, markup("ClosedCurve", name, points));
}

std::vector<MarkupPoint> read_markups(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be opened");
  std::vector<MarkupPoint> points;
  try {
    const nlohmann::json file = nlohmann::json::parse(in);
    for (const nlohmann::json& markup : file.at("markups")) append_points(markup, points);
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() +
                             ": not a readable 3D Slicer markups file: " + error.what());
  }
  return points;
}

}  // namespace mammotwin
