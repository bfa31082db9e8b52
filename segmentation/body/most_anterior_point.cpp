#include "segmentation/body/most_anterior_point.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

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

}  // namespace mammotwin
