#include "pipeline/validation/gel_breast_case.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "pipeline/validation/skin_distance.h"
#include "pipeline/validation/true_skin.h"
#include "registration/view/view_frame.h"
#include "solver/material/neo_hookean.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

constexpr double kC1 = 3;  // [kPa], the paper's silicone
constexpr double kNoise_mm = 0.3;
constexpr double kTrueStep_mm = 1;  // of the formula's triangles
constexpr double kTarget_mm = 0.3;
// The base reaches 10 mm before the wall; plates nearer to it would press the base and not the
// breast.
constexpr double kWallClearance_mm = 20;

/// Points of a skin about 1 mm apart, each moved by a Gaussian, cleaned as any scan is.
std::vector<Eigen::Vector3d> scanned(const TriangleSurface& skin) {
  std::mt19937 random(3);
  std::normal_distribution<double> gaussian(0, kNoise_mm);
  std::vector<Eigen::Vector3d> points = skin.vertices;
  for (auto& x : points)
    for (int a = 0; a < 3; ++a) x[a] += gaussian(random);
  return clean_scan(points).points;
}

CompressionProblem problem_of(const MeshFile& mesh) {
  CompressionProblem problem;
  problem.mesh = mesh;
  problem.tissue = [](const Eigen::Vector3d&, double) { return std::array<double, 3>{1, 0, 0}; };
  problem.laws.laws[0] = std::make_shared<NeoHookean>(kC1);
  problem.skin.on = false;
  const Eigen::Matrix3d axes = view_axes(Side::left, 0);
  problem.plates.depth = axes.row(0);
  problem.plates.up = axes.row(2);
  problem.plates.wall_clearance = kWallClearance_mm;
  return problem;
}

struct Pressed {
  CompressionReport report;
  MeshFile mesh;
};

Pressed press(const MeshFile& mesh, double thickness_mm) {
  CompressionProblem problem = problem_of(mesh);
  problem.plates.thickness = thickness_mm;
  const CompressionResult result = compress(problem, {}, {});
  Pressed pressed{result.report, mesh};
  pressed.mesh.mesh = HermiteMesh(result.deformed, mesh.mesh.elements());
  return pressed;
}

/// Skins and outlines of a state, whose meshes are as they then are.
void compare(const MeshFile& mesh, const MeshFile& truth, GelBreastState& state) {
  state.mesh = mesh;
  const TriangleSurface skin = skin_surface(mesh), true_skin = skin_surface(truth);
  state.to_true_rms_mm = rms_distance(skin, true_skin);
  state.scan = scanned(true_skin);
  state.to_scan_rms_mm = rms_distance(state.scan, skin);
  double top = -1e9, bottom = 1e9;  // of the true breast, for the outline's centre on its base
  for (const auto& x : true_skin.vertices) {
    if (x.y() > -20) continue;  // the base's surroundings
    top = std::max(top, x.z()), bottom = std::min(bottom, x.z());
  }
  const Eigen::Vector2d centre(0, (top + bottom) / 2);
  const std::vector<double> a = side_outline(skin, centre), b = side_outline(true_skin, centre);
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    squares += (a[i] - b[i]) * (a[i] - b[i]);
    state.outline_max_mm = std::max(state.outline_max_mm, std::abs(a[i] - b[i]));
  }
  state.outline_rms_mm = std::sqrt(squares / static_cast<double>(a.size()));
}

GelBreastState pressed_state(double fraction, const MeshFile& mesh, const MeshFile& truth) {
  GelBreastState state;
  state.compressed_fraction = fraction;
  state.thickness_mm = (1 - fraction) * free_thickness(mesh, problem_of(mesh).plates);
  const Pressed model = press(mesh, state.thickness_mm), exact = press(truth, state.thickness_mm);
  state.reached = model.report.usable() && exact.report.usable();
  state.reason = model.report.usable() ? exact.report.reason : model.report.reason;
  state.force_N = model.report.force_N;
  state.true_force_N = exact.report.force_N;
  state.seconds = model.report.seconds;
  state.true_seconds = exact.report.seconds;
  compare(model.mesh, exact.mesh, state);
  return state;
}

}  // namespace

GelBreastResult run_gel_breast(const std::filesystem::path& scan, const GelBreastMeshes& meshes,
                               const std::vector<double>& compressed_fractions,
                               const std::function<void(const std::string&)>& say) {
  const ScannedBreast breast = read_scanned_breast(scan, {});
  const ScannedSkin exact = true_skin(breast, kTrueStep_mm);
  FitOptions coarse, fine;
  coarse.elements = meshes.model;
  fine.elements = meshes.truth;
  say("gel breast: fitting its scan, and its true skin");
  const FitResult model = fit_breast(breast.segmentation, coarse, {}, &breast.skin);
  const FitResult truth = fit_breast(breast.segmentation, fine, {}, &exact);
  GelBreastResult result{model.report,
                         truth.report,
                         24 * model.mesh.mesh.num_nodes(),
                         24 * truth.mesh.mesh.num_nodes(),
                         {}};
  if (!model.report.usable() || !truth.report.usable()) return result;
  GelBreastState& free = result.states.emplace_back();
  free.reached = true;
  compare(model.mesh, truth.mesh, free);
  for (double fraction : compressed_fractions) {
    say("gel breast: pressing by " + std::to_string(std::lround(100 * fraction)) + " %");
    result.states.push_back(pressed_state(fraction, model.mesh, truth.mesh));
    say(to_json(result)["states"].back().dump());
  }
  return result;
}

nlohmann::json to_json(const GelBreastResult& r) {
  nlohmann::json states = nlohmann::json::array();
  for (const GelBreastState& s : r.states)
    states.push_back({{"compressed_fraction", s.compressed_fraction},
                      {"reached", s.reached},
                      {"reason", s.reason},
                      {"thickness_mm", s.thickness_mm},
                      {"force_N", s.force_N},
                      {"true_force_N", s.true_force_N},
                      {"to_true_rms_mm", s.to_true_rms_mm},
                      {"to_scan_rms_mm", s.to_scan_rms_mm},
                      {"outline_rms_mm", s.outline_rms_mm},
                      {"outline_max_mm", s.outline_max_mm},
                      {"seconds", s.seconds},
                      {"true_seconds", s.true_seconds}});
  return {
      {"noise_mm", r.fit.noise_mm}, {"dof", r.dof}, {"true_dof", r.true_dof}, {"states", states}};
}

std::vector<std::string> missed_targets(const GelBreastResult& r) {
  std::vector<std::string> missed;
  if (r.states.empty()) missed.push_back("gel breast: no mesh was fitted");
  for (const GelBreastState& s : r.states) {
    const std::string name = "gel breast, pressed by " +
                             std::to_string(std::lround(100 * s.compressed_fraction)) + " %: ";
    if (!s.reached)
      missed.push_back(name + s.reason);
    else if (std::max(s.to_true_rms_mm, s.to_scan_rms_mm) > kTarget_mm)
      missed.push_back(name + "the skin is more than 0.3 mm off");
  }
  return missed;
}

}  // namespace mammotwin
