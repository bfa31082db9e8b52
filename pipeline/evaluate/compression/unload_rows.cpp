#include "pipeline/evaluate/compression/unload_rows.h"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/steps/breast_problem.h"
#include "registration/carry/point_carrier.h"
#include "registration/view/plate_turn.h"
#include "registration/view/view_of_plates.h"
#include "segmentation/segmentation_file.h"
#include "solver/gravity/unload.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Nodes = std::vector<HermiteMesh::Node>;

constexpr double kCompressedShare = 0.45;  // of the free extent, as mammotwin-compress assumes
constexpr double kMloDeg = 45;
constexpr double kWallSprings[] = {0.02, 0.05, 0.08};  // [kPa/mm]

/// A breast of the folder; the problem keeps a reference to its fractions.
struct FittedBreast {
  Segmentation segmentation;
  MeshFile mesh;
  TissueSampler tissue;
  explicit FittedBreast(const std::filesystem::path& folder)
      : segmentation(
            read_segmentation(folder / "segmentation.seg.nrrd", folder / "fractions.nrrd")),
        mesh(read_mesh_file(folder / "prone.vtu")),
        tissue(tissue_of(mesh, segmentation.fractions)) {}

  BreastProblem problem(const CompressionSettings& settings, Pose pose, double factor) const {
    BreastProblem problem = breast_problem(mesh, tissue, settings, factor);
    problem.gravity = gravity_in_lps(pose);
    problem.density = GravitySettings().density();
    return problem;
  }
};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

json row_of(const std::string& stiffness, const UnloadReport& r, double seconds) {
  return {{"stiffness", stiffness},
          {"converged", r.usable()},
          {"reason", r.usable() ? json() : json(r.reason)},
          {"gravity_fraction", r.gravity_fraction},
          {"stability_margin", r.stability_margin},
          {"newton_iterations", r.newton_iterations},
          {"round_trip_max_mm", r.usable() ? json(r.round_trip_max_mm) : json()},
          {"naive_reversal_error_mm",
           r.naive_reversal_error_mm ? json(*r.naive_reversal_error_mm) : json()},
          {"sag_max_mm", r.sag_max_mm},
          {"stretch_p95", r.stretch_p95},
          {"solve_seconds", seconds}};
}

json unload_with(const std::string& name, const BreastProblem& problem) {
  UnloadOptions options;
  options.check = false;
  const double begin = cpu_seconds();
  unload(problem, options);
  const double seconds = cpu_seconds() - begin;
  return row_of(name, unload(problem, {}).report, seconds);
}

/// Largest way of a chest-wall node from unloaded to standing [mm]; null without convergence.
json standing_slide(const FittedBreast& breast, double spring) {
  CompressionSettings settings;
  settings.boundary.chest_wall_spring = spring;
  const BreastProblem prone = breast.problem(settings, Pose::prone, 1);
  UnloadOptions options;
  options.check = false;
  const UnloadResult unloaded = unload(prone, options);
  if (!unloaded.report.usable()) return nullptr;
  BreastProblem standing = from_unloaded(prone, unloaded.unloaded);
  standing.gravity = gravity_in_lps(Pose::standing);
  const HangResult state = hang(standing, {});
  if (!state.report.usable()) return nullptr;
  return wall_slide(standing.mesh, unloaded.unloaded, state.deformed);
}

struct ViewSolution {
  Nodes deformed;
  ViewFrame frame;
};

/// The breast between plates; the free thickness is the prone breast's, whatever the reference is.
ViewSolution squeeze(const FittedBreast& breast, const BreastProblem& loaded, double angle_deg) {
  CompressionProblem problem{loaded, {}, {}};
  problem.gravity.setZero();
  const Eigen::Matrix3d axes = usual_axes(
      breast.mesh, InverseMap(breast.mesh.mesh).nearest(breast.segmentation.nipple_in_lps),
      breast.segmentation.region.side, angle_deg);
  problem.plates.depth = axes.row(0);
  problem.plates.up = axes.row(2);
  problem.friction = CompressionSettings().friction;
  problem.plates.thickness = kCompressedShare * free_thickness(breast.mesh, problem.plates);
  const CompressionResult result = compress(problem, {});
  if (!result.report.usable()) throw std::runtime_error(result.report.reason);
  return {result.deformed, {origin_of_plates(problem.plates, result.plates), axes}};
}

std::vector<Eigen::Vector3d> element_middles(const HermiteMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (int e = 0; e < mesh.num_elements(); ++e)
    points.push_back(mesh.position({e, Eigen::Vector3d::Constant(0.5)}));
  return points;
}

json distances(const std::vector<Eigen::Vector3d>& prone_points, const HermiteMesh& prone,
               const ViewSolution& with, const ViewSolution& without) {
  if (prone_points.empty()) return nullptr;
  const PointCarrier carry_with(prone, HermiteMesh(with.deformed, prone.elements()));
  const PointCarrier carry_without(prone, HermiteMesh(without.deformed, prone.elements()));
  std::vector<double> found;
  for (const Eigen::Vector3d& x : prone_points)
    found.push_back((with.frame.view_from_lps(carry_with.carry(x).in_lps) -
                     without.frame.view_from_lps(carry_without.carry(x).in_lps))
                        .head<2>()
                        .norm());
  std::sort(found.begin(), found.end());
  return {
      {"count", found.size()}, {"median_mm", found[found.size() / 2]}, {"max_mm", found.back()}};
}

}  // namespace

json unload_rows(const std::filesystem::path& folder) {
  const FittedBreast breast(folder);
  CompressionSettings soft;
  soft.fat.c1_kpa = soft.fibroglandular.c1_kpa = soft.lesion.c1_kpa = 0.1;
  json rows = {unload_with("default", breast.problem({}, Pose::prone, 1)),
               unload_with("half", breast.problem({}, Pose::prone, 0.5)),
               unload_with("c1 = 0.1 kPa", breast.problem(soft, Pose::prone, 1))};
  json slides = json::object();
  for (const double spring : kWallSprings)
    slides[json(spring).dump()] = standing_slide(breast, spring);
  return {{"unloaded", rows}, {"standing_slide_max_mm", slides}};
}

json view_shifts(const std::filesystem::path& folder) {
  const FittedBreast breast(folder);
  const BreastProblem prone = breast.problem({}, Pose::prone, 1);
  UnloadOptions options;
  options.check = false;
  const UnloadResult unloaded = unload(prone, options);
  json shifts = json::object();
  std::vector<Eigen::Vector3d> lesions;
  for (const Lesion& lesion : breast.segmentation.lesions)
    lesions.push_back(lesion.centroid_in_lps);
  for (const auto& [view, angle] : {std::pair{"cc", 0.0}, {"mlo", kMloDeg}}) try {
      const ViewSolution with = squeeze(breast, from_unloaded(prone, unloaded.unloaded), angle);
      const ViewSolution without = squeeze(breast, prone, angle);
      shifts[view] = {{"lesions", distances(lesions, breast.mesh.mesh, with, without)},
                      {"points", distances(element_middles(breast.mesh.mesh), breast.mesh.mesh,
                                           with, without)}};
    } catch (const std::runtime_error& error) {
      shifts[view] = {{"reason", error.what()}};
    }
  return shifts;
}

}  // namespace mammotwin
