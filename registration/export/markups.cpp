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

}  // namespace mammotwin
