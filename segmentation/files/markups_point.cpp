#include "segmentation/files/markups_point.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace mammotwin {

Eigen::Vector3d read_markups_point(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) {
    return std::runtime_error(path.string() + ": " + what);
  };
  std::ifstream file(path);
  if (!file) throw fail("does not exist; expected a 3D Slicer markups file (.mrk.json)");
  try {
    const nlohmann::json markup = nlohmann::json::parse(file).at("markups").at(0);
    const std::string frame = markup.value("coordinateSystem", "LPS");
    if (frame != "LPS" && frame != "RAS")
      throw fail("coordinateSystem is \"" + frame + "\"; expected LPS or RAS");
    const nlohmann::json position = markup.at("controlPoints").at(0).at("position");
    const double sign = frame == "RAS" ? -1 : 1;
    return {sign * position.at(0).get<double>(), sign * position.at(1).get<double>(),
            position.at(2).get<double>()};
  } catch (const nlohmann::json::exception&) {
    throw fail("is no markups file with a control point; expected one saved by 3D Slicer");
  }
}

}  // namespace mammotwin
