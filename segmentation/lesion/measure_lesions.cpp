#include "segmentation/lesion/measure_lesions.h"

#include <map>

namespace mammotwin {

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

}  // namespace mammotwin
