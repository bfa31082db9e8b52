#include "pipeline/evaluate/victre/victre_comparison.h"

#include <algorithm>
#include <cmath>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/niftysim/round_skin.h"
#include "pipeline/evaluate/victre/victre_labels.h"
#include "pipeline/synthesize/mean_fractions.h"
#include "segmentation/image/distance.h"
#include "segmentation/segmentation.h"
#include "solver/material/neo_hookean.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

// What VICTRE's compression does (breastCompress.cxx): E of 5 and 15 kPa at nu = 0.49, muscle
// fixed, no skin; and where its paddles end (pc_1: faces 50 mm apart).
constexpr double kFatKpa = 5, kGlandKpa = 15, kPoisson = 0.49;
constexpr double kChestWallMm = 0;  // depth of the muscle's front, which is flat to 3 mm
constexpr double kPlateEdgeMm = 7.4, kPlateRoundingMm = 10;
constexpr double kComparedFromMm = 3;  // off the wall, where the muscle's curve does not matter
constexpr double kGridMm = 1;

double c1_of(double youngs_kpa) { return youngs_kpa / (2 * (1 + kPoisson)) / 2; }

template <class Visit>
void for_voxels(const Volume<std::uint8_t>& v, const Visit& visit) {
  for (int k = 0; k < v.size.z(); ++k)
    for (int j = 0; j < v.size.y(); ++j)
      for (int i = 0; i < v.size.x(); ++i) visit(v.position(i, j, k), v(i, j, k));
}

/// Voxels of the breast, in front of the wall, that have air beside them; every tenth of those,
/// which lie 0.2 mm apart.
std::vector<Vector3d> skin_points(const VictreLabels& labels) {
  constexpr int every = 10;
  int found = 0;
  std::vector<Vector3d> points;
  const double step = labels.values.spacing.x();
  for_voxels(labels.values, [&](const Vector3d& x, std::uint8_t value) {
    if (x.z() < kChestWallMm || !victre::is_breast(value)) return;
    for (int a = 0; a < 3; ++a)
      for (const double side : {-step, step})
        if (labels.at(x + side * Vector3d::Unit(a)) == 0) {
          if (found++ % every == 0) points.push_back(x + side / 2 * Vector3d::Unit(a));
          return;
        }
  });
  return points;
}

Vector3d middle_of_base(const std::vector<Vector3d>& skin) {
  Vector3d low = skin.front(), high = low;
  for (const auto& x : skin) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return {(low.x() + high.x()) / 2, (low.y() + high.y()) / 2, kChestWallMm};
}

/// Every third voxel: a quadrature point stands for some 3 mm.
Volume<Fractions> fractions_of(const VictreLabels& labels) {
  constexpr int every = 3;
  const auto& v = labels.values;
  Volume<Fractions> fractions(v.size / every, every * v.spacing, v.origin);
  for (int k = 0; k < fractions.size.z(); ++k)
    for (int j = 0; j < fractions.size.y(); ++j)
      for (int i = 0; i < fractions.size.x(); ++i) {
        const std::uint8_t value = v(every * i, every * j, every * k);
        if (!victre::is_breast(value)) continue;
        fractions(i, j, k) = victre::is_gland(value) ? Fractions{0, 1, 0} : Fractions{1, 0, 0};
      }
  return fractions;
}

/// Lowest and highest breast tissue between the flat parts of the plates.
std::pair<double, double> heights(const VictreLabels& labels) {
  std::pair<double, double> range{1e9, -1e9};
  const double half = labels.values.spacing.y() / 2;
  for_voxels(labels.values, [&](const Vector3d& x, std::uint8_t value) {
    if (x.z() < kPlateEdgeMm + kPlateRoundingMm || !victre::is_breast(value)) return;
    range = {std::min(range.first, x.y() - half), std::max(range.second, x.y() + half)};
  });
  return range;
}

CompressionProblem problem_of(const MeshFile& mesh, const Volume<Fractions>& fractions,
                              const std::pair<double, double>& between) {
  CompressionProblem problem;
  problem.mesh = mesh;
  const auto mean = std::make_shared<MeanFractions>(fractions);
  problem.tissue = [mean](const Vector3d& x, double volume) {
    const Fractions f = mean->at(x, volume);
    return std::array<double, 3>{f.fat, f.fibroglandular, f.lesion};
  };
  const auto gland = std::make_shared<NeoHookean>(c1_of(kGlandKpa));
  problem.laws.laws = {std::make_shared<NeoHookean>(c1_of(kFatKpa)), gland, gland};
  problem.skin.on = false;
  problem.boundary.chest_wall = ChestWall::clamped;
  PlateOptions& plates = problem.plates;
  plates.up = Vector3d::UnitY();
  plates.depth = Vector3d::UnitZ();
  plates.wall_clearance = kPlateEdgeMm - kChestWallMm;
  plates.rounding = kPlateRoundingMm;
  plates.thickness = between.second - between.first;
  plates.lift = (between.first + between.second) / 2 - PlateFrame(mesh, plates).centroid_height();
  return problem;
}

/// The labels that stand at the points of `grid` when the mesh is deformed.
Volume<std::uint8_t> carried(const VictreLabels& labels, const HermiteMesh& reference,
                             const HermiteMesh& deformed, const Volume<std::uint8_t>& grid) {
  const InverseMap locate(deformed);
  Volume<std::uint8_t> result = grid.like<std::uint8_t>();
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i)
        if (const auto p = locate.locate(grid.position(i, j, k)))
          result(i, j, k) = labels.at(reference.position(*p));
  return result;
}

Volume<std::uint8_t> sampled(const VictreLabels& labels, const Volume<std::uint8_t>& grid) {
  Volume<std::uint8_t> result = grid.like<std::uint8_t>();
  for (int k = 0; k < grid.size.z(); ++k)
    for (int j = 0; j < grid.size.y(); ++j)
      for (int i = 0; i < grid.size.x(); ++i) result(i, j, k) = labels.at(grid.position(i, j, k));
  return result;
}

Volume<std::uint8_t> mask_of(const Volume<std::uint8_t>& labels, bool (*belongs)(std::uint8_t)) {
  Volume<std::uint8_t> mask = labels;
  for (std::uint8_t& v : mask.values) v = belongs(v);
  return mask;
}

double dice(const Volume<std::uint8_t>& a, const Volume<std::uint8_t>& b) {
  double both = 0, sum = 0;
  for (std::size_t n = 0; n < a.values.size(); ++n)
    both += a.values[n] && b.values[n], sum += a.values[n] + b.values[n];
  return 2 * both / sum;
}

/// Voxels of a mask with a neighbour outside it, off the chest wall.
Volume<std::uint8_t> outline(const Volume<std::uint8_t>& mask) {
  const Volume<std::uint8_t> inner = eroded(mask, kGridMm);
  Volume<std::uint8_t> edge = mask;
  for (std::size_t n = 0; n < edge.values.size(); ++n)
    edge.values[n] = mask.values[n] && !inner.values[n];
  return edge;
}

/// Distances from each outline to the other [mm].
json outline_distance(const Volume<std::uint8_t>& a, const Volume<std::uint8_t>& b) {
  const auto edge_a = outline(a), edge_b = outline(b);
  const auto to_a = distance_to(edge_a), to_b = distance_to(edge_b);
  std::vector<float> all;
  for (std::size_t n = 0; n < edge_a.values.size(); ++n) {
    if (edge_a.values[n]) all.push_back(to_b.values[n]);
    if (edge_b.values[n]) all.push_back(to_a.values[n]);
  }
  std::sort(all.begin(), all.end());
  double sum = 0;
  for (const float d : all) sum += d;
  return {{"mean_mm", sum / all.size()}, {"p95_mm", all[all.size() * 95 / 100]}};
}

void compare(json& figures, const std::string& prefix, const Volume<std::uint8_t>& ours,
             const Volume<std::uint8_t>& theirs) {
  const auto our_breast = mask_of(ours, victre::is_breast);
  const auto their_breast = mask_of(theirs, victre::is_breast);
  figures[prefix + "breast_dice"] = dice(our_breast, their_breast);
  figures[prefix + "gland_dice"] =
      dice(mask_of(ours, victre::is_gland), mask_of(theirs, victre::is_gland));
  figures[prefix + "outline"] = outline_distance(our_breast, their_breast);
}

/// Of the compressed phantom, in front of the wall.
Volume<std::uint8_t> comparison_grid(const VictreLabels& theirs) {
  const auto& v = theirs.values;
  Vector3d low = v.origin;
  low.z() = kComparedFromMm;
  const Vector3d high = v.position(v.size.x() - 1, v.size.y() - 1, v.size.z() - 1);
  return Volume<std::uint8_t>(((high - low) / kGridMm).cast<int>(), Vector3d::Constant(kGridMm),
                              low);
}

json figures_of(const CompressionReport& r) {
  return {{"reason", r.reason},
          {"thickness_mm", r.thickness_mm},
          {"free_thickness_mm", r.free_thickness_mm},
          {"force_N", r.force_N},
          {"min_J", r.min_J},
          {"max_J", r.max_J},
          {"volume_change", r.volume_change},
          {"max_penetration_mm", r.max_penetration_mm},
          {"newton_iterations", r.newton_iterations},
          {"dof", r.dof},
          {"seconds", r.seconds}};
}

}  // namespace

VictreComparison compare_with_victre(const std::filesystem::path& folder,
                                     const HalfBallElements& elements) {
  const VictreLabels before = read_victre_labels(folder, "p_1");
  const VictreLabels theirs = read_victre_labels(folder, "pc_1");
  const auto skin = skin_points(before);
  const RoundSkin round(middle_of_base(skin), skin);
  const MeshFile mesh = fit_half_ball(round, elements);
  const Volume<Fractions> fractions = fractions_of(before);
  CompressionOptions options;
  options.solid.bulk_ratio = 100;  // the least there is; VICTRE's is 50
  const CompressionResult ours = compress(problem_of(mesh, fractions, heights(theirs)), options);

  VictreComparison result;
  result.figures = figures_of(ours.report);
  result.figures["elements"] = mesh.mesh.num_elements();
  result.figures["skin_rms_mm"] = round.rms();
  result.reason = ours.report.reason;
  const auto grid = comparison_grid(theirs);
  const auto their_labels = sampled(theirs, grid);
  const HermiteMesh deformed(ours.deformed, mesh.mesh.elements());
  compare(result.figures, "", carried(before, mesh.mesh, deformed, grid), their_labels);
  compare(result.figures, "uncompressed_", sampled(before, grid), their_labels);
  return result;
}

}  // namespace mammotwin
