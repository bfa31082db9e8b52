#include "segmentation/files/markups.h"

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mammotwin {

namespace {

using nlohmann::json;

/// A markups file while it is read; what JSON lacks is said as `expected`.
class MarkupsFile {
 public:
  MarkupsFile(const std::filesystem::path& path, std::string expected)
      : path_(path), expected_(std::move(expected)) {}

  std::runtime_error fault(const std::string& what) const {
    return std::runtime_error(path_.string() + ": " + what);
  }

  /// What `take` makes of the file's markups.
  template <class Take>
  auto read(const Take& take) const {
    std::ifstream file(path_);
    if (!file) throw fault("does not exist; expected a 3D Slicer markups file (.mrk.json)");
    try {
      return take(json::parse(file).at("markups"));
    } catch (const json::exception&) {
      throw fault("is no markups file with " + expected_ + "; expected one saved by 3D Slicer");
    }
  }

  Eigen::Vector3d in_lps(const json& markup, const json& position) const {
    const std::string frame = markup.value("coordinateSystem", "LPS");
    if (frame != "LPS" && frame != "RAS")
      throw fault("coordinateSystem is \"" + frame + "\"; expected LPS or RAS");
    const double sign = frame == "RAS" ? -1 : 1;
    return {sign * position.at(0).get<double>(), sign * position.at(1).get<double>(),
            position.at(2).get<double>()};
  }

 private:
  std::filesystem::path path_;
  std::string expected_;
};

/// Do columns of a rotation run along the axes, one each?
bool runs_along_axes(const std::vector<double>& orientation) {
  const double least = std::cos(std::numbers::pi / 180);
  if (orientation.size() != 9) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(orientation[3 * axis + axis]) < least) return false;
  return true;
}

}  // namespace

Eigen::Vector3d read_markups_point(const std::filesystem::path& path) {
  const MarkupsFile file(path, "a control point");
  return file.read([&](const json& markups) {
    const json& markup = markups.at(0);
    return file.in_lps(markup, markup.at("controlPoints").at(0).at("position"));
  });
}

std::vector<Eigen::Vector3d> read_markups_points(const std::filesystem::path& path) {
  const MarkupsFile file(path, "control points");
  return file.read([&](const json& markups) {
    std::vector<Eigen::Vector3d> points;
    for (const json& markup : markups)
      for (const json& point : markup.at("controlPoints"))
        points.push_back(file.in_lps(markup, point.at("position")));
    if (points.empty()) throw file.fault("holds no control point; expected some");
    return points;
  });
}

Eigen::AlignedBox3d read_markups_box(const std::filesystem::path& path) {
  const MarkupsFile file(path, "an ROI");
  return file.read([&](const json& markups) {
    const json& roi = markups.at(0);
    if (!runs_along_axes(roi.at("orientation").get<std::vector<double>>()))
      throw file.fault("the ROI is turned; expected sides along the patient's axes");
    const Eigen::Vector3d centre = file.in_lps(roi, roi.at("center"));
    const auto size = roi.at("size").get<std::array<double, 3>>();
    const Eigen::Vector3d half = Eigen::Vector3d(size[0], size[1], size[2]).cwiseAbs() / 2;
    if (half.minCoeff() <= 0) throw file.fault("the ROI is flat; expected a box");
    return Eigen::AlignedBox3d((centre - half).eval(), (centre + half).eval());
  });
}

}  // namespace mammotwin
