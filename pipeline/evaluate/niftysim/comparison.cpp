#include "pipeline/evaluate/niftysim/comparison.h"

#include <algorithm>
#include <numbers>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/niftysim/roll_hold.h"
#include "pipeline/evaluate/niftysim/round_skin.h"
#include "pipeline/evaluate/niftysim/tetra_forces.h"
#include "pipeline/evaluate/niftysim/tetra_tissue.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using nlohmann::json;

constexpr double kDegrees = 180 / std::numbers::pi;

double area(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return (b - a).cross(c - a).norm() / 2;
}

/// The skin's nodes and area: outer faces that are not all on the fixed plane.
struct Skin {
  std::vector<Vector3d> points;
  double area = 0;
};

Skin skin_of(const NiftySimModel& model) {
  std::vector<char> fixed(model.nodes.size(), 0), on_skin(model.nodes.size(), 0);
  for (const int n : model.fixed_nodes) fixed[n] = 1;
  Skin skin;
  for (const auto& f : outer_faces(model)) {
    if (fixed[f[0]] && fixed[f[1]] && fixed[f[2]]) continue;
    skin.area += area(model.nodes[f[0]], model.nodes[f[1]], model.nodes[f[2]]);
    for (const int n : f) on_skin[n] = 1;
  }
  for (std::size_t n = 0; n < on_skin.size(); ++n)
    if (on_skin[n]) skin.points.push_back(model.nodes[n]);
  return skin;
}

/// Middle of the chest-wall face's box, in its plane z = 0.
Vector3d middle_of_base(const NiftySimModel& model) {
  Vector3d low = model.nodes[model.fixed_nodes[0]], high = low;
  for (const int n : model.fixed_nodes)
    low = low.cwiseMin(model.nodes[n]), high = high.cwiseMax(model.nodes[n]);
  return {(low.x() + high.x()) / 2, (low.y() + high.y()) / 2, 0};
}

json distances(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double squares = 0;
  for (const double v : values) squares += v * v;
  return {{"rms_mm", std::sqrt(squares / values.size())},
          {"p95_mm", values[static_cast<std::size_t>(0.95 * (values.size() - 1))]},
          {"max_mm", values.back()}};
}

json compare_nodes(const HermiteMesh& reference, const HermiteMesh& deformed,
                   const NiftySimModel& model, const std::vector<Vector3d>& theirs) {
  const InverseMap locate(reference);
  std::vector<double> apart, moved, off;
  for (std::size_t n = 0; n < theirs.size(); ++n) {
    const MeshPoint p = locate.nearest(model.nodes[n]);
    const Vector3d ours = deformed.position(p) - reference.position(p);
    const Vector3d their = theirs[n] - model.nodes[n];
    off.push_back((reference.position(p) - model.nodes[n]).norm());
    apart.push_back((ours - their).norm());
    moved.push_back(their.norm());
  }
  return {{"displacement_difference", distances(apart)},
          {"their_displacement", distances(moved)},
          {"nodes_off_mesh", distances(off)},
          {"nodes", theirs.size()}};
}

double roll_of_base(const NiftySimModel& model, const std::vector<Vector3d>& x) {
  std::vector<Vector3d> before, after;
  for (const int n : model.fixed_nodes) before.push_back(model.nodes[n]), after.push_back(x[n]);
  return roll_of(before, after);
}

json figures_of(const Squeeze& s) {
  return {{"reason", s.reason},
          {"dof", s.dof},
          {"steps", s.steps},
          {"newton_iterations", s.iterations},
          {"min_J", s.min_J},
          {"max_J", s.max_J},
          {"volume_change", s.volume_change},
          {"max_penetration_mm", s.penetration_mm},
          {"force_N", s.force_N},
          {"roll_deg", s.roll * kDegrees},
          {"couple_N_mm", -s.couple_N_mm},
          {"seconds", s.seconds}};
}

}  // namespace

NiftySimComparison compare_with_niftysim(const fs::path& folder, const NiftySimOptions& options) {
  const NiftySimModel model = read_niftysim_model(folder / "volmesh3-model.xml");
  const auto theirs = read_vtk_points(folder / "volmesh3_compressed.vtk");
  if (theirs.size() != model.nodes.size())
    throw std::runtime_error((folder / "volmesh3_compressed.vtk").string() + ": has " +
                             std::to_string(theirs.size()) + " nodes; expected the model's " +
                             std::to_string(model.nodes.size()));
  const Skin skin = skin_of(model);
  const RoundSkin round(middle_of_base(model), skin.points);
  NiftySimComparison result;
  result.compressed = fit_half_ball(round, options.elements);
  MeshFile& mesh = result.compressed;

  SqueezeOptions squeeze;
  squeeze.grad_div = options.grad_div;
  if (options.skin) squeeze.skin_thickness = volume_of_set(model, 2) / skin.area;
  if (options.held_roll) squeeze.roll = roll_of_base(model, theirs);
  const Squeeze ours = squeeze_between_plates(mesh, model, tissue_of_tetrahedra(model), squeeze);
  const HermiteMesh deformed(ours.deformed, mesh.mesh.elements());
  const PlateCouple couple = plate_couple(model, theirs);

  result.reason = ours.reason;
  result.figures = compare_nodes(mesh.mesh, deformed, model, theirs);
  result.figures.update(figures_of(ours));
  result.figures["elements"] = mesh.mesh.num_elements();
  result.figures["skin_rms_mm"] = round.rms();
  result.figures["skin_membrane_mm"] = squeeze.skin_thickness;
  result.figures["theirs"] = {{"roll_deg", roll_of_base(model, theirs) * kDegrees},
                              {"force_N", couple.force_N},
                              {"couple_N_mm", couple.couple_N_mm},
                              {"roll_acceleration_rad_per_s2", couple.roll_acceleration}};
  mesh.configurations["prone"] = mesh.mesh.nodes();
  mesh.mesh = deformed;
  return result;
}

}  // namespace mammotwin
