#include "pipeline/validation/known_skins.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "fitting/mesh/block_mesh.h"
#include "fitting/scan/scanned_breast.h"
#include "fitting/slab/skin_patches.h"
#include "fitting/surface/closest_point.h"
#include "fitting/surface/face_mesh.h"
#include "pipeline/synthesize/gel_breast.h"
#include "pipeline/validation/box_fit.h"

namespace mammotwin {
namespace {

constexpr int kPatches = 3;
constexpr double kMost_mm = 6;         // that a parameter of the skin moves
constexpr double kTruthStep_mm = 0.5;  // of the formula's triangles: 0.01 mm off on the nipple
constexpr int kFaceDivisions = 16;

/// The box whose front's parameters 0 to 3 moved along y; its sides stay in their planes.
HermiteMesh uneven_box(const Slab& slab) {
  std::vector<HermiteMesh::Node> nodes = box_nodes(slab);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int j = 0; j <= kPatches; ++j)
    for (int i = 0; i <= kPatches; ++i)
      for (int d = 0; d < 4; ++d) nodes[slab.node(i, j, 1)](1, d) += kMost_mm * uniform(random);
  return HermiteMesh(nodes, grid_corners(slab.elements));
}

/// Squared distances of a mesh's skin to the true one.
ScanAccuracy accuracy_of(const TriangleSurface& skin, const Eigen::Isometry3d& file_from_frame) {
  const ClosestPoint truth(gel_breast_surface(kTruthStep_mm));
  const ScanHoles holes = gel_breast_holes();
  const std::vector<double> areas = skin.vertex_areas();
  double all = 0, area = 0, outside = 0, outside_area = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const Eigen::Vector3d x = file_from_frame * skin.vertices[v];
    const double squared = areas[v] * (truth(x).x - x).squaredNorm();
    all += squared, area += areas[v];
    const bool in_hole =
        std::any_of(holes.middles.begin(), holes.middles.end(),
                    [&](const Eigen::Vector3d& m) { return (x - m).norm() <= holes.radius_mm; });
    if (!in_hole) outside += squared, outside_area += areas[v];
  }
  return {std::sqrt(outside / outside_area), std::sqrt(all / area)};
}

}  // namespace

double hermite_skin_left_mm() {
  constexpr int points_per_side = 61, steps = 12;
  const Slab slab{{kPatches, kPatches, 1}};
  const SkinPatches patches(slab, uneven_box(slab));
  const Skin skin = [&](double u, double v) { return patches.at({kPatches * u, kPatches * v}).x; };
  std::vector<HermiteMesh::Node> nodes = box_nodes(slab);
  // So near the truth nothing has to be held from sliding, and steps converge quadratically.
  return fit_box(slab, skin, {points_per_side, steps, 0}, nodes);
}

ScanAccuracy gel_scan_accuracy(const std::filesystem::path& scan) {
  const ScannedBreast breast = read_scanned_breast(scan, {});
  const FitResult fit = fit_breast(breast.segmentation, {}, {}, &breast.skin);
  if (!fit.report.usable()) throw std::runtime_error(scan.string() + ": no mesh was fitted to it");
  const TriangleSurface skin =
      face_mesh(fit.mesh.mesh, fit.mesh.faces, FaceLabel::skin, kFaceDivisions).surface;
  ScanAccuracy accuracy = accuracy_of(skin, breast.frame_from_file.inverse());
  accuracy.holes = breast.holes;
  accuracy.noise_mm = breast.skin.noise_mm;
  return accuracy;
}

nlohmann::json known_skins_table(const std::filesystem::path& scan) {
  constexpr double millionths = 1e6;
  const ScanAccuracy accuracy = gel_scan_accuracy(scan);
  return {{"cases",
           {{{"name", "a Hermite surface of 3 x 3 patches, by distance alone"},
             {"left_millionths_mm", millionths * hermite_skin_left_mm()}},
            {{"name", "the gel breast's scan"},
             {"outside_holes_mm", accuracy.outside_holes_mm},
             {"all_mm", accuracy.all_mm}}}}};
}

}  // namespace mammotwin
