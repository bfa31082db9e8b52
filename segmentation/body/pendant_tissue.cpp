#include "segmentation/body/pendant_tissue.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/image/components.h"

namespace mammotwin {
namespace {

constexpr double breastbone_mm = 10, apex_height_mm = 10;
constexpr double least_stand_mm = 12, least_stand_share = 0.25;  // as for the body's frame

/// How far forward [mm] the skin over the breastbone reaches.
double sternal_front(const TissueColumns& columns, const ColumnBox& medial) {
  double lowest = INFINITY;
  for (int i = medial.i0; i <= medial.i1; ++i) {
    double front = -INFINITY;
    for (int k = medial.k0; k <= medial.k1; ++k)
      front = std::max(front, columns.front[columns.at(i, k)]);
    if (std::isfinite(front)) lowest = std::min(lowest, front);
  }
  return lowest;
}

}  // namespace

bool PendantTissue::contains(const Eigen::Vector3d& x) const {
  return x.y() < sternal_y && x.z() >= z_low && x.z() <= z_high &&
         (side == Side::left ? x.x() >= medial_x : x.x() <= medial_x);
}

PendantTissue find_pendant_tissue(const Volume<std::uint8_t>& labels, const TissueColumns& columns,
                                  const ColumnBox& half, int apex_i, int apex_k, Side side) {
  const int across = std::max(1, static_cast<int>(std::lround(breastbone_mm / labels.spacing.x())));
  const int along = static_cast<int>(std::lround(apex_height_mm / labels.spacing.z()));
  ColumnBox medial{half.i0, half.i1, std::max(half.k0, apex_k - along),
                   std::min(half.k1, apex_k + along)};
  if (side == Side::left)
    medial.i1 = std::min(half.i1, half.i0 + across);
  else
    medial.i0 = std::max(half.i0, half.i1 - across);
  const double sternum = sternal_front(columns, medial);
  const double needed = std::max(
      least_stand_mm, least_stand_share * (columns.front[columns.at(apex_i, apex_k)] - sternum));
  const auto stands = [&](int k) {
    double front = -INFINITY;
    for (int i = half.i0; i <= half.i1; ++i)
      front = std::max(front, columns.front[columns.at(i, k)]);
    return front - sternum > needed;
  };
  int low = apex_k, high = apex_k;
  while (low > half.k0 && stands(low - 1)) --low;
  while (high < half.k1 && stands(high + 1)) ++high;
  const int first = side == Side::left ? half.i0 : half.i1;
  const double outward = side == Side::left ? -0.5 : 0.5;
  return {-sternum, labels.position(0, 0, low).z(), labels.position(0, 0, high).z(),
          labels.position(first, 0, 0).x() + outward * labels.spacing.x(), side};
}

Volume<std::uint8_t> hanging_tissue(const PendantTissue& pendant,
                                    const Volume<std::uint8_t>& labels) {
  auto hanging = labels.like<std::uint8_t>(0);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        hanging(i, j, k) =
            label::is_breast(labels(i, j, k)) && pendant.contains(labels.position(i, j, k));
  return largest_component(hanging);
}

double lateral_reach(const PendantTissue& pendant, const Volume<std::uint8_t>& hanging,
                     double share) {
  std::vector<double> counts(hanging.size.x(), 0);
  double beyond = 0;
  for (int k = 0; k < hanging.size.z(); ++k)
    for (int j = 0; j < hanging.size.y(); ++j)
      for (int i = 0; i < hanging.size.x(); ++i)
        counts[i] += hanging(i, j, k), beyond += share * hanging(i, j, k);
  const bool left = pendant.side == Side::left;
  int i = left ? hanging.size.x() - 1 : 0;
  for (const int end = left ? 0 : hanging.size.x() - 1; i != end && beyond >= counts[i];
       i += left ? -1 : 1)
    beyond -= counts[i];
  const double part = counts[i] > 0 ? beyond / counts[i] : 0;  // of the last column
  return hanging.position(i, 0, 0).x() + (left ? 0.5 - part : part - 0.5) * hanging.spacing.x();
}

OutsideRegion outside_region(const Volume<std::uint8_t>& hanging, const BreastRegion& region) {
  OutsideRegion outside;
  double all = 0, out = 0;
  for (int k = 0; k < hanging.size.z(); ++k)
    for (int j = 0; j < hanging.size.y(); ++j)
      for (int i = 0; i < hanging.size.x(); ++i) {
        if (!hanging(i, j, k)) continue;
        ++all;
        const Eigen::Vector3d x = hanging.position(i, j, k);
        if (!region.contains(x)) ++out, outside.middle_in_lps += x;
      }
  if (out > 0) outside.middle_in_lps /= out;
  outside.share = all > 0 ? out / all : 0;
  outside.volume_ml = out * hanging.voxel_volume() / 1000;
  return outside;
}

}  // namespace mammotwin
