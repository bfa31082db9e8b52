#include "segmentation/body/midline.h"

#include <vector>

#include "segmentation/body/apices.h"

namespace mammotwin {

std::optional<double> find_midline(const Volume<std::uint8_t>& labels) {
  const std::vector<double> fronts =
      column_fronts(labels, [&](int i, int j, int k) { return label::is_breast(labels(i, j, k)); });
  const std::vector<double> front = front_profile(fronts, labels.size.x(), 0, labels.size.z() - 1);
  // Columns beyond the body are no valley: only what lies between finite values counts.
  const auto apices = find_apices(front, labels.spacing.x());
  if (!apices) return std::nullopt;
  return labels.origin.x() + apices->valley * labels.spacing.x();
}

bool is_on_side(double x, double midline, Side side) {
  return side == Side::left ? x >= midline : x <= midline;
}

void keep_side(Volume<std::uint8_t>& labels, double midline, Side side) {
  for (int i = 0; i < labels.size.x(); ++i) {
    if (is_on_side(labels.position(i, 0, 0).x(), midline, side)) continue;
    for (int k = 0; k < labels.size.z(); ++k)
      for (int j = 0; j < labels.size.y(); ++j) labels(i, j, k) = label::air;
  }
}

}  // namespace mammotwin
