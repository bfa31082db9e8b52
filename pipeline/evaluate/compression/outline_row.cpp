#include "pipeline/evaluate/compression/outline_row.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "registration/search/silhouette.h"
#include "registration/view/compressed_view.h"
#include "solver/contact/plate_placement.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr double kMostSd = 2;
constexpr double kMm3PerMl = 1000;

double angle_deg(int ray) {
  const Eigen::Vector2d d = ray_direction(ray);
  return std::atan2(d.y(), d.x()) * 180 / std::numbers::pi;
}

/// Largest depth and lateral extent of an outline.
struct Extent {
  double depth = 0, low = 0, high = 0;
  void add(double radius, int ray) {
    const Eigen::Vector2d x = radius * ray_direction(ray);
    depth = std::max(depth, x.x());
    low = std::min(low, x.y());
    high = std::max(high, x.y());
  }
  double width() const { return high - low; }
};

/// Middle of the skin's lateral extent in front of the detector's edge.
Eigen::Vector2d middle_of(const ReducedView& view) {
  double low = 1e30, high = -1e30;
  for (const HermiteMesh::Node& node : view.base)
    if (node(0, 0) > 0) {
      low = std::min(low, node(1, 0));
      high = std::max(high, node(1, 0));
    }
  return {0, (low + high) / 2};
}

RayDistances outline_of(const MeshFile& file, const CompressedView& geometry) {
  ReducedView view;
  view.elements = file.mesh.elements();
  view.base = in_view(file.mesh.nodes(), geometry.frame);
  Detector parallel;
  parallel.source_distance_mm = kParallel_mm;
  return Silhouette(view, file.faces).at(view, ViewState::Zero(), parallel, middle_of(view));
}

/// Depth at a lateral place off the outline's middle, between the two directions that see it; empty
/// where there is no skin.
std::optional<double> depth_at(const RayDistances& outline, double lateral) {
  for (int ray = 0; ray + 1 < kRays; ++ray) {
    if (!outline[ray] || !outline[ray + 1]) continue;
    const Eigen::Vector2d a = *outline[ray] * ray_direction(ray);
    const Eigen::Vector2d b = *outline[ray + 1] * ray_direction(ray + 1);
    if ((a.y() - lateral) * (b.y() - lateral) > 0) continue;
    return a.x() + (b.x() - a.x()) * (lateral - a.y()) / (b.y() - a.y());
  }
  return std::nullopt;
}

json medial_deeper(const RayDistances& outline, double width_mm) {
  const auto medial = depth_at(outline, -width_mm / 4), middle = depth_at(outline, 0),
             lateral = depth_at(outline, width_mm / 4);
  if (!medial || !middle || !lateral) return nullptr;
  return (*medial - *lateral) / *middle;
}

}  // namespace

json outline_row(const MeshFile& compressed, const OutlinePopulation& population) {
  const CompressedView view = compressed_view("cc", "the compressed mesh", compressed.metadata);
  const Eigen::Vector3d depth = view.frame.axes.row(0);
  const double volume =
      volume_in_front(compressed.mesh, depth, depth.dot(view.frame.origin_in_lps)) / kMm3PerMl;
  json row{{"thickness_mm", view.thickness_mm},
           {"volume_ml", volume},
           {"typical_thickness_mm", population.typical_thickness_mm(volume)}};
  for (const char* key : {"population_volume_ml", "compared", "within_2_sd", "mean_sd", "worst_sd",
                          "depth_mm", "width_mm", "population_depth_mm", "population_width_mm",
                          "depth_ratio", "width_ratio", "medial_deeper"})
    row[key] = nullptr;
  if (view.thickness_mm < OutlinePopulation::kThinnest_mm ||
      view.thickness_mm > OutlinePopulation::kThickest_mm)
    return row;
  row["population_volume_ml"] = population.volume_ml(view.thickness_mm);
  Extent ours, theirs;
  int compared = 0, within = 0;
  double sum = 0, worst = 0;
  const RayDistances outline = outline_of(compressed, view);
  for (int ray = 0; ray < kRays; ++ray) {
    if (!outline[ray]) continue;
    const OutlinePopulation::Radius radius = population.at(view.thickness_mm, angle_deg(ray));
    const double off = (*outline[ray] - radius.mean_mm) / radius.sd_mm;
    ++compared;
    within += std::abs(off) <= kMostSd;
    sum += off;
    if (std::abs(off) > std::abs(worst)) worst = off;
    ours.add(*outline[ray], ray);
    theirs.add(radius.mean_mm, ray);
  }
  row["compared"] = compared;
  if (compared == 0) return row;
  row["within_2_sd"] = static_cast<double>(within) / compared;
  row["mean_sd"] = sum / compared;
  row["worst_sd"] = worst;
  row["depth_mm"] = ours.depth;
  row["width_mm"] = ours.width();
  row["population_depth_mm"] = theirs.depth;
  row["population_width_mm"] = theirs.width();
  row["medial_deeper"] = medial_deeper(outline, ours.width());
  row["depth_ratio"] = ours.depth / theirs.depth;
  row["width_ratio"] = ours.width() / theirs.width();
  return row;
}

}  // namespace mammotwin
