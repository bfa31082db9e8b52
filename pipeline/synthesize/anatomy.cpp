#include "pipeline/synthesize/anatomy.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double air_in_front_mm = 16, half_height_mm = 105, beside_mm = 34;
constexpr double back_y_mm = 98;  // the field of view ends in the thorax
constexpr double near_mm = 9;     // within this of a surface the distance is made true

GlandField make_gland(const Chest& chest, Side side, const AnatomyOptions& o) {
  const double larger = side == o.side ? 1 : 1 + o.asymmetry;
  const double volume_mm3 = 1000 * o.density * o.volume_ml * larger;
  const double fat_margin = 9 * (1 - o.density);  // dense breasts have less fat under the skin
  return GlandField(chest, side, o.seed + (side == o.side ? 0 : 1), volume_mm3, fat_margin);
}

/// Value and gradient of a field that is a distance only to first order, divided by the
/// gradient's length: x -> value + gradient (x - centre) is then the distance.
struct Plane {
  double value = 0;
  Vector3d gradient = Vector3d::Zero();
  double at(const Vector3d& offset) const { return value + gradient.dot(offset); }
};

template <class Field>
Plane tangent_plane(const Field& field, const Vector3d& x) {
  Plane plane{field(x), Vector3d::Zero()};
  if (std::abs(plane.value) > near_mm) return plane;
  constexpr double h = 0.25;  // small against the radii of the body, large against rounding
  for (int a = 0; a < 3; ++a)
    plane.gradient[a] =
        (field(x + h * Vector3d::Unit(a)) - field(x - h * Vector3d::Unit(a))) / (2 * h);
  const double slope = std::max(plane.gradient.norm(), 0.2);
  plane.value /= slope, plane.gradient /= slope;
  return plane;
}

Substance substance_of(Organ organ) {
  switch (organ) {
    case Organ::rib:
      return Substance::rib;
    case Organ::lung:
      return Substance::lung;
    case Organ::heart:
      return Substance::heart;
    case Organ::liver:
      return Substance::liver;
    case Organ::muscle:
      break;
  }
  return Substance::muscle;
}

}  // namespace

Anatomy::Anatomy(const AnatomyOptions& o)
    : options_(o),
      chest_(o),
      glands_{make_gland(chest_, Side::left, o), make_gland(chest_, Side::right, o)},
      lesions_(place_lesions(chest_, o)) {}

void Anatomy::add_sample(VoxelMixture& mixture, const Vector3d& x, double outside, double wall,
                         Substance behind) const {
  if (outside > 0) {
    ++mixture[Substance::air];
    return;
  }
  if (wall <= 0) {
    ++mixture[behind];
    return;
  }
  const bool in_nipple = chest_.nipple(x) < 0;
  if (outside > -options_.skin_mm || (in_nipple && chest_.without_nipples(x) > -options_.skin_mm)) {
    ++mixture[Substance::skin];
    return;
  }
  for (std::size_t n = 0; n < lesions_.size(); ++n)
    if (lesions_[n].contains(x)) {
      ++mixture[Substance::lesion];
      mixture.lesion = static_cast<std::uint8_t>(n);
      return;
    }
  const bool gland = in_nipple || glands_[0](x) < 0 || glands_[1](x) < 0;
  ++mixture[gland ? Substance::fibroglandular : Substance::fat];
}

VoxelMixture Anatomy::sample_voxel(const Vector3d& centre, double voxel_mm, int samples) const {
  const Plane outside = tangent_plane([&](const Vector3d& x) { return chest_.outside(x); }, centre);
  const Plane wall = tangent_plane([&](const Vector3d& x) { return chest_.chest_wall(x); }, centre);
  VoxelMixture mixture;
  const auto all = static_cast<std::uint8_t>(samples * samples * samples);
  if (outside.value > voxel_mm) return mixture[Substance::air] = all, mixture;
  const Substance behind = substance_of(chest_.torso().organ(centre));
  if (wall.value < -voxel_mm && outside.value < -voxel_mm) return mixture[behind] = all, mixture;
  for (int c = 0; c < samples; ++c)
    for (int b = 0; b < samples; ++b)
      for (int a = 0; a < samples; ++a) {
        const Vector3d offset =
            voxel_mm *
            ((Vector3d(a, b, c) + Vector3d::Constant(0.5)) / samples - Vector3d::Constant(0.5));
        add_sample(mixture, centre + offset, outside.at(offset), wall.at(offset), behind);
      }
  return mixture;
}

TissueMap Anatomy::sample(double voxel_mm, int samples) const {
  const double half_width = options_.chest_half_width_mm + beside_mm;
  const Vector3d low(-half_width, chest_.front_y() - air_in_front_mm, -half_height_mm);
  const Vector3d high(half_width, back_y_mm, half_height_mm);
  const Vector3i size = ((high - low) / voxel_mm).cast<int>() + Vector3i::Ones();
  TissueMap map{Volume<VoxelMixture>(size, Vector3d::Constant(voxel_mm), low),
                samples * samples * samples};
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        map.mixtures(i, j, k) = sample_voxel(map.mixtures.position(i, j, k), voxel_mm, samples);
  });
  return map;
}

}  // namespace mammotwin
