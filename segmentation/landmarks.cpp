#include "segmentation/landmarks.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mammotwin {

Eigen::Vector3d most_anterior_point(const Volume<std::uint8_t>& labels,
                                    const BreastRegion& region) {
  constexpr double flat_mm = 1;
  std::vector<Eigen::Vector3d> fronts;
  double front = std::numeric_limits<double>::infinity();
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      if (!region.contains(labels.position(i, 0, k))) continue;
      int j = 0;
      while (j < labels.size.y() && !label::is_breast(labels(i, j, k))) ++j;
      if (j == labels.size.y()) continue;
      fronts.push_back(labels.position(i, j, k));
      front = std::min(front, fronts.back().y());
    }
  if (fronts.empty()) throw std::runtime_error("the breast's region holds no breast");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Eigen::Vector3d& x : fronts)
    if (x.y() <= front + flat_mm) sum += x, ++count;
  return {sum.x() / count, front - labels.spacing.y() / 2, sum.z() / count};
}

std::vector<Lesion> measure_lesions(const Volume<std::uint8_t>& labels) {
  struct Sum {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    std::size_t count = 0;
  };
  std::map<int, Sum> sums;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        if (!label::is_lesion(labels(i, j, k))) continue;
        Sum& sum = sums[labels(i, j, k)];
        sum.x += labels.position(i, j, k);
        ++sum.count;
      }
  std::vector<Lesion> lesions;
  for (const auto& [value, sum] : sums)
    lesions.push_back({"lesion-" + std::to_string(value - label::lesion + 1),
                       sum.x / static_cast<double>(sum.count),
                       sum.count * labels.voxel_volume() / 1000});
  return lesions;
}

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
