#include "fitting/surface/skin_to_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fitting/surface/flatten.h"
#include "fitting/surface/label_surface.h"

namespace mammotwin {

namespace {

constexpr double sigma_mm = 1;
constexpr double spacing_mm = 2;
constexpr double snap_mm = 0.1;                                     // a twentieth of the spacing
constexpr std::array<int, 3> closings = {2, 3, 5};                  // voxels
constexpr std::array<double, 7> pulls = {3, 6, 9, 12, 15, 18, 21};  // [mm]
constexpr double lesion_margin_mm = 3;
constexpr double edge_reach_mm = 40;  // an element and a half
// 2.5 at most in 21 breasts that fit well, 6.3 in one that did not.
constexpr double too_much_graze = 4, usual_graze = 2.5;
constexpr int grazed_pull_mm = 6;

/// Edges named by bits: x_min, x_max, z_min, z_max.
BreastRegion pulled_in(BreastRegion r, int edges, double by) {
  if (edges & 1) r.x_min += by;
  if (edges & 2) r.x_max -= by;
  if (edges & 4) r.z_min += by;
  if (edges & 8) r.z_max -= by;
  return r;
}

double radius_mm(const Lesion& lesion) {
  constexpr double pi = 3.14159265358979;
  return std::cbrt(3 * 1000 * lesion.volume_ml / (4 * pi));
}

bool holds_lesions(const BreastRegion& r, const std::vector<Lesion>& lesions) {
  return std::all_of(lesions.begin(), lesions.end(), [&](const Lesion& lesion) {
    const Eigen::Vector3d& x = lesion.centroid_in_lps;
    const double reach = radius_mm(lesion) + lesion_margin_mm;
    return x.x() - reach > r.x_min && x.x() + reach < r.x_max && x.z() - reach > r.z_min &&
           x.z() + reach < r.z_max;
  });
}

/// Sets of edges, those with fewest first.
std::vector<int> edge_sets() {
  std::vector<int> sets;
  for (int edges = 1; edges < 16; ++edges) sets.push_back(edges);
  std::stable_sort(sets.begin(), sets.end(), [](int a, int b) {
    return std::popcount(static_cast<unsigned>(a)) < std::popcount(static_cast<unsigned>(b));
  });
  return sets;
}

std::string doubt_of(int edges, double by) {
  std::string names;
  constexpr std::array<const char*, 4> edge_names = {"right", "left", "lower", "upper"};
  for (int e = 0; e < 4; ++e)
    if (edges >> e & 1) names += (names.empty() ? "" : " and ") + std::string(edge_names[e]);
  return "The skin is too ragged or too steep at the breast's " + names + " edge; the mesh ends " +
         std::to_string(static_cast<int>(by)) + " mm inside it there.";
}

std::string joined(const std::string& first, const std::string& second) {
  return first.empty() ? second : first + " " + second;
}

double area(const TriangleSurface& surface) {
  const std::vector<double> areas = surface.vertex_areas();
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// Skin within 1 mm of an edge's plane over the area of a straight band of 1 mm: the mean of
/// 1 / sin of the angle at which the two meet, more where the edge winds.
double graze(const SkinToFit& skin, int edge) {
  constexpr double band_mm = 1;
  const BreastRegion& r = skin.region;
  const double length = edge < 2 ? r.z_max - r.z_min : r.x_max - r.x_min;
  const TriangleSurface rest = cropped(skin.surface, pulled_in(r, 1 << edge, band_mm), snap_mm);
  return (area(skin.surface) - area(rest)) / (band_mm * length);
}

/// Each edge that the skin grazes pulled in as little as ends that; as it is where nothing does.
SkinToFit without_grazed_edges(SkinToFit skin, const std::vector<Lesion>& lesions) {
  for (int edge = 0; edge < 4; ++edge) {
    if (graze(skin, edge) <= too_much_graze) continue;
    for (int by = 1; by <= grazed_pull_mm; ++by) {
      const BreastRegion region = pulled_in(skin.region, 1 << edge, by);
      if (!holds_lesions(region, lesions)) break;
      const SkinToFit next{cropped(skin.surface, region, snap_mm), region,
                           joined(skin.doubt, doubt_of(1 << edge, by))};
      if (!why_not_a_square(next.surface, region).empty()) continue;
      if (graze(next, edge) > usual_graze) continue;
      skin = next;
      break;
    }
  }
  return skin;
}

/// As little closed and as little of the region left out as makes the skin a disc with corners.
SkinToFit find_disc(const Segmentation& s, const MuscleFront& wall) {
  TriangleSurface boundary;
  std::string reason;
  for (int closing : closings) {
    const Volume<float> solid = solid_from_labels(s.labels, s.region, wall.height, {closing});
    boundary = solid_boundary(resampled(smoothed(solid, sigma_mm), spacing_mm));
    const TriangleSurface skin = cropped(boundary, s.region, snap_mm);
    reason = why_not_a_square(skin, s.region);
    if (reason.empty()) return {skin, s.region, ""};
  }
  const TriangleSurface around = cropped(boundary, s.region, snap_mm);
  for (double by : pulls)
    for (int edges : edge_sets()) {
      const BreastRegion region = pulled_in(s.region, edges, by);
      if (!holds_lesions(region, s.lesions)) continue;
      const TriangleSurface skin = cropped(around, region, snap_mm);
      if (why_not_a_square(skin, region).empty()) return {skin, region, doubt_of(edges, by)};
    }
  throw std::runtime_error("fit: the skin surface cannot be laid on a square: " + reason +
                           "; look at the segmentation for holes, or for a breast that the "
                           "field of view or the region's planes cut");
}

}  // namespace

SkinToFit find_skin_to_fit(const Segmentation& segmentation, const MuscleFront& wall) {
  return without_grazed_edges(find_disc(segmentation, wall), segmentation.lesions);
}

SkinToFit without_edges_near(const Eigen::Vector3d& place, double by, const SkinToFit& skin,
                             const std::vector<Lesion>& lesions) {
  const BreastRegion& r = skin.region;
  int edges = 0;
  const std::array<double, 4> distance = {place.x() - r.x_min, r.x_max - place.x(),
                                          place.z() - r.z_min, r.z_max - place.z()};
  for (int e = 0; e < 4; ++e)
    if (distance[e] < edge_reach_mm) edges |= 1 << e;
  const BreastRegion region = pulled_in(r, edges, by);
  if (edges == 0 || !holds_lesions(region, lesions)) return {{}, region, ""};
  const TriangleSurface surface = cropped(skin.surface, region, snap_mm);
  if (!why_not_a_square(surface, region).empty()) return {{}, region, ""};
  return {surface, region, joined(skin.doubt, doubt_of(edges, by))};
}

SkinToFit scanned_skin_to_fit(const TriangleSurface& scan, const BreastRegion& region) {
  const TriangleSurface skin = cropped(scan, region, snap_mm);
  if (const std::string reason = why_not_a_square(skin, region); !reason.empty())
    throw std::runtime_error("fit: the scanned skin cannot be laid on a square: " + reason +
                             "; does the scan cover the breast's surroundings?");
  return {skin, region, ""};
}

TriangleSurface skin_as_labelled(const Segmentation& s, const BreastRegion& region,
                                 const MuscleFront& wall) {
  const Volume<float> solid = solid_from_labels(s.labels, region, wall.height, {});
  return cropped(solid_boundary(solid), region, s.labels.spacing.minCoeff() / 20);
}

}  // namespace mammotwin
