#include "segmentation/image/crop.h"

namespace mammotwin {

VoxelBox box_around(const Volume<std::uint8_t>& mask, int margin) {
  VoxelBox box{mask.size, Eigen::Vector3i::Constant(-1)};
  for (int k = 0; k < mask.size.z(); ++k)
    for (int j = 0; j < mask.size.y(); ++j)
      for (int i = 0; i < mask.size.x(); ++i) {
        if (mask(i, j, k) == 0) continue;
        box.low = box.low.cwiseMin(Eigen::Vector3i(i, j, k));
        box.high = box.high.cwiseMax(Eigen::Vector3i(i, j, k));
      }
  box.low = (box.low.array() - margin).max(0);
  box.high = (box.high.array() + margin).min(mask.size.array() - 1);
  return box;
}

}  // namespace mammotwin
