#include "segmentation/chest_wall/muscle_slips.h"

#include <algorithm>
#include <cmath>

#include "segmentation/image/components.h"
#include "segmentation/image/distance.h"
#include "segmentation/image/masked.h"

namespace mammotwin {
namespace {

constexpr double core_mm = 1.6;  // from the core's surface to gland's: vessels have no core
constexpr double least_core_ml = 0.3;
constexpr double begins_mm = 6.5;  // from the wall: its blur and the core's distance, and 3 mm
constexpr double ends_mm = 15;     // no muscle stands further off
constexpr double nearly_all = 0.9;
constexpr double as_bright = 1.25;                     // times muscle, or its inverse
constexpr float muscle_from_mm = 2, muscle_to_mm = 8;  // behind the wall
constexpr double least_ml = 3, most_ml = 12;           // more is a layer of gland

/// Median brightness of what lies just behind the wall.
double muscle_brightness(const HalfBreast& half, const Volume<float>& image) {
  const Volume<float> behind = distance_to(half.inside);
  auto muscle = half.body.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < muscle.values.size(); ++v)
    muscle.values[v] =
        half.body.values[v] && behind.values[v] > muscle_from_mm && behind.values[v] < muscle_to_mm;
  return median_in(image, muscle);
}

/// A connected piece: where, how bright, and how far off the wall.
struct Piece {
  double brightness = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<float> above_wall;

  double voxels() const { return static_cast<double>(above_wall.size()); }
  double begins() const { return *std::min_element(above_wall.begin(), above_wall.end()); }
  double ends() {
    const auto at = above_wall.begin() + static_cast<std::ptrdiff_t>(nearly_all * (voxels() - 1));
    std::nth_element(above_wall.begin(), at, above_wall.end());
    return *at;
  }
};

/// One a component, from 1; none is empty.
std::vector<Piece> pieces_of(const Components& parts, const HalfBreast& half,
                             const Volume<float>& image) {
  std::vector<Piece> pieces(parts.sizes.size());
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i) {
        const std::int32_t part = parts.ids(i, j, k);
        if (part == 0) continue;
        pieces[part].brightness += image(i, j, k);
        pieces[part].middle += image.position(i, j, k);
        pieces[part].above_wall.push_back(half.above_wall(i, j, k));
      }
  for (Piece& piece : pieces)
    if (piece.voxels() > 0) piece.brightness /= piece.voxels(), piece.middle /= piece.voxels();
  return pieces;
}

}  // namespace

std::vector<MuscleSlip> find_muscle_slips(const HalfBreast& half,
                                          const Volume<float>& gland_fraction,
                                          const Volume<float>& image) {
  auto gland = half.inside.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < gland.values.size(); ++v)
    gland.values[v] = gland_fraction.values[v] > 0.5F;
  const Components wholes = connected_components(gland);
  const Components cores = connected_components(eroded(gland, core_mm));
  std::vector<Piece> whole = pieces_of(wholes, half, image), core = pieces_of(cores, half, image);
  std::vector<std::int32_t> whole_of(core.size(), 0);
  for (std::size_t v = 0; v < image.values.size(); ++v)
    whole_of[cores.ids.values[v]] = wholes.ids.values[v];
  const double muscle = muscle_brightness(half, image);
  const double voxel_ml = image.voxel_volume() / 1000;
  std::vector<std::uint8_t> is_slip(whole.size(), 0);
  for (std::size_t n = 1; n < core.size(); ++n)
    if (core[n].voxels() * voxel_ml >= least_core_ml && core[n].begins() < begins_mm &&
        std::abs(std::log(core[n].brightness / muscle)) < std::log(as_bright) &&
        whole[whole_of[n]].ends() < ends_mm)
      is_slip[whole_of[n]] = 1;
  std::vector<MuscleSlip> slips;
  for (std::size_t n = 1; n < whole.size(); ++n)
    if (is_slip[n])
      slips.push_back({whole[n].voxels() * voxel_ml, whole[n].ends(), whole[n].middle});
  return slips;
}

void judge_muscle_slips(const std::vector<MuscleSlip>& slips, const BreastRegion& region,
                        SegmentQuality& quality) {
  for (const MuscleSlip& slip : slips) {
    if (slip.ml < least_ml || slip.ml > most_ml || !region.contains(slip.middle_in_lps)) continue;
    quality.doubt(SegmentStatus::look,
                  {"chest wall",
                   std::to_string(std::lround(slip.ml)) +
                       " ml that lie on the chest wall found are as bright as muscle: taken as "
                       "fibroglandular tissue; if they are muscle, the wall lies up to " +
                       std::to_string(std::lround(slip.forward_mm)) + " mm further forward there",
                   slip.middle_in_lps, ball_radius_mm(slip.ml)});
  }
}

}  // namespace mammotwin
