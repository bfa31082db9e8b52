#include "pipeline/synthesize/map_body.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "pipeline/synthesize/map_thorax.h"
#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Mask = Volume<std::uint8_t>;

constexpr double least_lesion_ml = 0.1;
constexpr double side_skin_mm = 2.5;  // of the flanks, where the map has none

template <class Visit>
void for_each_voxel(const Vector3i& size, const Visit& visit) {
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i) visit(i, j, k);
}

std::uint8_t code(Substance s) { return static_cast<std::uint8_t>(s); }

std::uint8_t code(ForeignTissue tissue) {
  switch (tissue) {
    case ForeignTissue::air:
      return code(Substance::air);
    case ForeignTissue::skin:
      return code(Substance::skin);
    case ForeignTissue::fat:
      return code(Substance::fat);
    case ForeignTissue::transition:
      return MapBody::transition;
    case ForeignTissue::muscle:
      return code(Substance::muscle);
    case ForeignTissue::lesion:
      return code(Substance::lesion);
    default:
      return code(Substance::fibroglandular);
  }
}

Mask substances(const Volume<std::uint16_t>& map, const LabelValues& values) {
  auto out = map.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < out.values.size(); ++v)
    out.values[v] = code(values.at(map.values[v]));
  return out;
}

/// Puts the middle of all tissue at x = 0: scores tell the sides by the sign of x.
void centre(Mask& body) {
  int low = body.size.x(), high = -1;
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i)
        if (body(i, j, k)) low = std::min(low, i), high = std::max(high, i);
  body.origin.x() = -body.spacing.x() * (low + high) / 2;
}

/// Lesions numbered from 1, the largest first; smaller ones than the least become gland.
Mask number_lesions(Mask& body) {
  auto is_lesion = body.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < body.values.size(); ++v)
    is_lesion.values[v] = body.values[v] == code(Substance::lesion);
  const Components parts = connected_components(is_lesion);
  std::vector<std::int32_t> order(parts.sizes.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return parts.sizes[a] > parts.sizes[b]; });
  std::vector<std::uint8_t> number(parts.sizes.size(), 0);
  for (std::size_t n = 0; n < order.size() && n < 200; ++n)
    if (parts.sizes[order[n]] * body.voxel_volume() / 1000 >= least_lesion_ml)
      number[order[n]] = static_cast<std::uint8_t>(n + 1);
  auto lesion = body.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < body.values.size(); ++v) {
    lesion.values[v] = number[parts.ids.values[v]];
    if (is_lesion.values[v] && lesion.values[v] == 0)
      body.values[v] = code(Substance::fibroglandular);
  }
  return lesion;
}

int last_row(const Mask& body) {
  int last = 0;
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = last; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i)
        if (body(i, j, k)) last = std::max(last, j);
  return last;
}

/// Fat from the map's last row of tissue to the back, beside what lies behind the muscle.
void continue_flanks(Mask& body, const WallFront& front, int last) {
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = 0; i < body.size.x(); ++i) {
      if (front.at(i, k) < body.size.y()) continue;
      int j = last;  // holes just above the last row belong to it
      while (j > last - 3 && !body(i, j, k)) --j;
      if (!body(i, j, k)) continue;
      for (++j; j < body.size.y(); ++j) body(i, j, k) = code(Substance::fat);
    }
  auto air = body.like<std::uint8_t>(0);  // what lies behind the front is yet to be filled
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = 0; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i)
        air(i, j, k) = body(i, j, k) == 0 && j < front.at(i, k);
  const Volume<float> depth = distance_to(air);
  for (int k = 0; k < body.size.z(); ++k)
    for (int j = last + 1; j < body.size.y(); ++j)
      for (int i = 0; i < body.size.x(); ++i)
        if (body(i, j, k) == code(Substance::fat) && depth(i, j, k) < side_skin_mm)
          body(i, j, k) = code(Substance::skin);
}

/// Map voxel under each sample point along one axis; -1 beyond the map.
std::vector<int> sampled_indices(double spacing, int map_size, double voxel_mm, int samples,
                                 int size) {
  std::vector<int> indices;
  for (int n = 0; n < size; ++n)
    for (int s = 0; s < samples; ++s) {
      const double at = voxel_mm * (n + (s + 0.5) / samples - 0.5) / spacing;
      const int index = static_cast<int>(std::lround(at));
      indices.push_back(index >= 0 && index < map_size ? index : -1);
    }
  return indices;
}

void add_sample(const MapBody& body, int i, int j, int k, int n, VoxelMixture& mixture) {
  if (i < 0 || j < 0 || k < 0) return void(++mixture[Substance::air]);
  const std::uint8_t s = body.substance(i, j, k);
  if (s == MapBody::transition)
    return void(++mixture[n % 2 ? Substance::fibroglandular : Substance::fat]);
  ++mixture.parts[s];
  if (const std::uint8_t lesion = body.lesion(i, j, k); lesion > 0)
    mixture.lesion = static_cast<std::uint8_t>(lesion - 1);
}

}  // namespace

MapBody body_of_map(const Volume<std::uint16_t>& map, const LabelValues& values,
                    std::uint64_t seed) {
  MapBody body;
  body.substance = substances(map, values);
  centre(body.substance);
  body.lesion = number_lesions(body.substance);
  const WallFront front = front_of_muscle(body.substance);
  const int last = last_row(body.substance);
  body.last_y = body.substance.position(0, last, 0).y();
  continue_flanks(body.substance, front, last);
  fill_thorax(front, seed, body.substance);
  return body;
}

namespace {

struct Width {
  double low = 1e9, high = -1e9;
  void hold(double x) { low = std::min(low, x), high = std::max(high, x); }
};

/// Most anterior tissue in the ten middle columns: the skin over the breastbone.
double front_between_breasts(const Mask& body) {
  double front = 1e9;
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = body.size.x() / 2 - 5; i < body.size.x() / 2 + 5; ++i)
      for (int j = 0; j < body.size.y(); ++j)
        if (body(i, j, k)) {
          front = std::min(front, body.position(i, j, k).y());
          break;
        }
  return front;
}

}  // namespace

void press_between_plates(MapBody& body, double share) {
  Mask& s = body.substance;
  const double sternum = front_between_breasts(s);
  Width widths[2];
  const auto hangs = [&](int i, int j, int k) {
    return s(i, j, k) != code(Substance::air) && s.position(i, j, k).y() < sternum;
  };
  for_each_voxel(s.size, [&](int i, int j, int k) {
    if (const double x = s.position(i, j, k).x(); hangs(i, j, k)) widths[x > 0].hold(x);
  });
  const auto beyond = [&](double x) {
    const Width& w = widths[x > 0];
    return std::abs(x - (w.low + w.high) / 2) - share * (w.high - w.low) / 2;
  };
  for_each_voxel(s.size, [&](int i, int j, int k) {
    const double out = beyond(s.position(i, j, k).x());
    if (!hangs(i, j, k) || out < -side_skin_mm) return;
    s(i, j, k) = code(out > 0 ? Substance::air : Substance::skin);
    body.lesion(i, j, k) = 0;
  });
}

TissueMap MapBody::sample(double voxel_mm, int samples) const {
  const Vector3d extent =
      (substance.size - Vector3i::Ones()).cast<double>().cwiseProduct(substance.spacing);
  const Vector3i size = (extent / voxel_mm).cast<int>() + Vector3i::Ones();
  TissueMap map{Volume<VoxelMixture>(size, Vector3d::Constant(voxel_mm), substance.origin),
                samples * samples * samples};
  std::array<std::vector<int>, 3> at;
  for (int d = 0; d < 3; ++d)
    at[d] = sampled_indices(substance.spacing[d], substance.size[d], voxel_mm, samples, size[d]);
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        for (int n = 0; n < map.parts_per_voxel; ++n)
          add_sample(*this, at[0][i * samples + n % samples],
                     at[1][j * samples + n / samples % samples],
                     at[2][k * samples + n / samples / samples], n, map.mixtures(i, j, k));
  });
  return map;
}

}  // namespace mammotwin
