#include "pipeline/synthesize/mean_fractions.h"

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

/// First and last voxel along an axis whose centre lies in the cube; at least the nearest one.
struct Reach {
  int first, last;
  Reach(double index, double half_width, int size)
      : first(static_cast<int>(std::ceil(index - half_width))),
        last(static_cast<int>(std::floor(index + half_width))) {
    if (first > last) first = last = static_cast<int>(std::lround(index));
    first = std::max(first, 0);
    last = std::min(last, size - 1);
  }
};

}  // namespace

Fractions MeanFractions::at(const Eigen::Vector3d& x_in_lps, double volume) const {
  const Eigen::Vector3d index = fractions_.index(x_in_lps);
  const double half_side = std::cbrt(volume) / 2;
  const Reach reach[3] = {{index[0], half_side / fractions_.spacing[0], fractions_.size[0]},
                          {index[1], half_side / fractions_.spacing[1], fractions_.size[1]},
                          {index[2], half_side / fractions_.spacing[2], fractions_.size[2]}};
  double fat = 0, fibroglandular = 0, lesion = 0;
  for (int k = reach[2].first; k <= reach[2].last; ++k)
    for (int j = reach[1].first; j <= reach[1].last; ++j)
      for (int i = reach[0].first; i <= reach[0].last; ++i) {
        const Fractions& voxel = fractions_(i, j, k);
        fat += voxel.fat;
        fibroglandular += voxel.fibroglandular;
        lesion += voxel.lesion;
      }
  const double sum = fat + fibroglandular + lesion;
  if (sum <= 0) return {1, 0, 0};
  return {static_cast<float>(fat / sum), static_cast<float>(fibroglandular / sum),
          static_cast<float>(lesion / sum)};
}

}  // namespace mammotwin
