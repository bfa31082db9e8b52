#include "segmentation/body/tissue_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "segmentation/image/components.h"

namespace mammotwin {

TissueColumns measure_columns(const Volume<std::uint8_t>& labels) {
  auto muscle = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    muscle.values[v] = labels.values[v] == label::muscle;
  muscle = without_small_components(muscle, least_muscle_ml);

  TissueColumns columns{labels.size.x(), labels.size.z(), {}, {}, {}};
  const double dy = labels.spacing.y();
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i) {
      double tissue = 0, front = -std::numeric_limits<double>::infinity();
      int j = 0;
      for (; j < labels.size.y() && !muscle(i, j, k); ++j) {
        if (!label::is_breast(labels(i, j, k))) continue;
        if (tissue == 0) front = -labels.position(i, j, k).y();
        tissue += dy;
      }
      columns.tissue.push_back(tissue);
      columns.front.push_back(front);
      columns.on_muscle.push_back(j < labels.size.y());
    }
  return columns;
}

void set_muscle_back(Volume<std::uint8_t>& labels, const BreastRegion& region, double least_mm) {
  const int deep = static_cast<int>(std::ceil(least_mm / labels.spacing.y()));
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      if (!region.contains(labels.position(i, 0, k))) continue;
      int first = 0;
      while (first < labels.size.y() && labels(i, first, k) == label::air) ++first;
      for (int j = first; j < std::min(first + deep, labels.size.y()); ++j)
        if (labels(i, j, k) == label::muscle)
          labels(i, j, k) = j == first ? label::skin : label::fat;
    }
}

void ColumnBox::hold(int i, int k) {
  i0 = std::min(i0, i), i1 = std::max(i1, i);
  k0 = std::min(k0, k), k1 = std::max(k1, k);
}

}  // namespace mammotwin
