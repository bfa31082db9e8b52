#include "solver/gel_cylinder.h"

#include "fitting/mesh/cylinder_mesh.h"
#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/load/load_stepping.h"
#include "solver/material/neo_hookean.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <stdexcept>

namespace mammotwin {

namespace {

constexpr double kWhole = 4;           // the model carries a quarter of the plates' force
constexpr double kEighths = 8;
constexpr double kNewtonPerMilli = 1e-3, kMilliJoulePerMicro = 1e-3;
constexpr double kOnPlane = 1e-6;      // [mm]

/// Elements of a mesh with all corners at x, y >= 0, their nodes renumbered, ties kept.
MeshFile quadrant(const MeshFile& whole) {
  std::vector<int> index(whole.mesh.num_nodes(), -1);
  std::vector<HermiteMesh::Node> nodes;
  std::vector<HermiteMesh::Corners> elements;
  MeshFile part{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  for (int e = 0; e < whole.mesh.num_elements(); ++e) {
    const Eigen::Vector3d middle = whole.mesh.position({e, {0.5, 0.5, 0.5}});
    if (middle.x() < 0 || middle.y() < 0) continue;
    HermiteMesh::Corners corners = whole.mesh.corners(e);
    for (int& corner : corners) {
      if (index[corner] < 0) {
        index[corner] = static_cast<int>(nodes.size());
        nodes.push_back(whole.mesh.node(corner));
      }
      corner = index[corner];
    }
    elements.push_back(corners);
    part.faces.push_back(whole.faces[e]);
  }
  part.mesh = HermiteMesh(std::move(nodes), std::move(elements));
  for (ParameterTie tie : whole.ties) {
    tie.node = index[tie.node];
    tie.to_node = index[tie.to_node];
    if (tie.node >= 0 && tie.to_node >= 0) part.ties.push_back(tie);
  }
  return part;
}

MeshFile eighth(const CylinderExperiment& x) {
  const CylinderElements elements{2 * x.refinement, (x.refinement + 1) / 2, x.refinement + 1, 0.5};
  return quadrant(cylinder_mesh(x.diameter / 2, x.length / 2, elements));
}

bool in_plane(const HermiteMesh& mesh, int e, int face, int axis, double value) {
  for (int c = 0; c < 8; ++c)
    if ((c >> (face / 2) & 1) == face % 2 &&
        std::abs(mesh.node(mesh.corners(e)[c])(axis, 0) - value) > kOnPlane)
      return false;
  return true;
}

FaceList faces_in_plane(const HermiteMesh& mesh, int axis, double value) {
  FaceList faces;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (in_plane(mesh, e, face, axis, value)) faces.push_back({e, face});
  return faces;
}

void hold(const HermiteMesh& mesh, const FaceList& faces, int component, DofMap& dofs) {
  for (const auto& [e, face] : faces)
    for (int dof : face_dofs(mesh, e, face, component)) dofs.prescribe(dof);
}

int node_at(const HermiteMesh& mesh, const Eigen::Vector3d& x) {
  int nearest = 0;
  for (int i = 1; i < mesh.num_nodes(); ++i)
    if ((mesh.node(i).col(0) - x).norm() < (mesh.node(nearest).col(0) - x).norm()) nearest = i;
  return nearest;
}

void check(const CylinderExperiment& x) {
  if (!(x.diameter > 0 && x.length > 0 && x.thickness > 0))
    throw std::invalid_argument("gel cylinder: diameter, length and thickness must be positive");
  if (x.refinement < 1 || x.steps < 1 || x.contact_points < 4 || x.contact_points > 10)
    throw std::invalid_argument("gel cylinder: refinement and steps must be at least 1, contact "
                                "points 4 to 10");
}

/// One run. The plate's normal is y (lateral, plane strain) or z (axial, bonded).
class CylinderRun {
 public:
  explicit CylinderRun(const CylinderExperiment& experiment)
      : x_(experiment), file_(eighth(experiment)), mesh_(file_.mesh), dofs_(mesh_) {
    check(x_);
    const auto gel = std::make_shared<NeoHookean>(x_.c1);
    model_ = std::make_unique<Model>(
        mesh_, [gel](const Eigen::Vector3d&, double) { return gel; },
        SolidOptions{PressureSpace::trilinear, 1e6, 0});
    hold_symmetry();
    place_plate();
    for (const ParameterTie& tie : file_.ties)
      for (int i = 0; i < 3; ++i)
        dofs_.tie(dof_index(tie.node, tie.parameter, i),
                  dof_index(tie.to_node, tie.to_parameter, i), tie.factor);
    dofs_.number(mesh_);
    newton_ = std::make_unique<Newton>(*model_, dofs_);
  }

  CylinderFigures run();

 private:
  bool lying() const {
    return x_.how == CylinderCase::lateral || x_.how == CylinderCase::plane_strain;
  }
  bool bonded() const { return x_.how == CylinderCase::bonded; }
  bool by_contact() const { return lying(); }  // standing, the flat plate's motion is prescribed
  double start() const { return lying() ? x_.diameter / 2 : x_.length / 2; }
  double height(double fraction) const { return start() + fraction * (x_.thickness / 2 - start()); }
  double end() const { return x_.length / 2; }

  void hold_symmetry();
  void place_plate();
  NewtonReport equilibrate(double fraction, State& state);
  NewtonReport move_end(double fraction, State& state);
  double force(const State& state) const;
  CylinderFigures measure(const State& state) const;

  CylinderExperiment x_;
  MeshFile file_;
  const HermiteMesh& mesh_;
  DofMap dofs_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<Newton> newton_;
  std::shared_ptr<PlateContact> contact_;
  FaceList contact_faces_;
  PenaltyOptions penalties_;
};

void CylinderRun::hold_symmetry() {
  for (int axis = 0; axis < 3; ++axis) hold(mesh_, faces_in_plane(mesh_, axis, 0), axis, dofs_);
  const FaceList ends = faces_in_plane(mesh_, 2, end());
  if (x_.how == CylinderCase::plane_strain || x_.how == CylinderCase::axial)
    hold(mesh_, ends, 2, dofs_);
  if (bonded())
    for (int i = 0; i < 3; ++i) hold(mesh_, ends, i, dofs_);
}

void CylinderRun::place_plate() {
  penalties_.last = x_.penalty;
  if (!by_contact()) return;
  contact_ = std::make_shared<PlateContact>();
  contact_->points1d = x_.contact_points;
  const Eigen::Vector3d normal = -Eigen::Vector3d::UnitY();
  contact_->plates = {Plate{-start() * normal, normal, Eigen::Vector3d::UnitX(), 0, true}};
  for (int e = 0; e < mesh_.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (file_.faces[e][face] == FaceLabel::skin) contact_faces_.push_back({e, face});
  for (const auto& [e, face] : contact_faces_)
    model_->add_surface_potential(e, face, contact_, contact_->points1d);
}

NewtonReport CylinderRun::move_end(double fraction, State& state) {
  std::vector<HermiteMesh::Node> pending(mesh_.num_nodes(), HermiteMesh::Node::Zero());
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    if (std::abs(mesh_.node(i)(2, 0) - end()) < kOnPlane)
      pending[i](2, 0) = height(fraction) - state.x[i](2, 0);
  return newton_->solve(state, penalties_.newton, pending);
}

NewtonReport CylinderRun::equilibrate(double fraction, State& state) {
  if (!by_contact()) return move_end(fraction, state);
  contact_->plates[0].point = -height(fraction) * contact_->plates[0].normal;
  const double size = std::cbrt(model_->volume() / mesh_.num_elements());
  NewtonReport report = solve_contact(*newton_, *contact_, 2 * x_.c1 / size, penalties_, state);
  if (!report.usable() || x_.gap_tolerance == 0) return report;
  const NewtonReport last = close_gap(
      *newton_, *contact_, x_.gap_tolerance,
      [&](const State& s) {
        return contact_figures(*model_, s, *contact_, 0, contact_faces_).penetration;
      },
      penalties_.newton, state);
  report.iterations += last.iterations;
  return report;
}

double CylinderRun::force(const State& state) const {
  if (by_contact())
    return kWhole * contact_figures(*model_, state, *contact_, 0, contact_faces_).force.norm();
  double sum = 0;
  const auto residual = newton_->assembler().nodal_residual(state);
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    if (std::abs(mesh_.node(i)(2, 0) - end()) < kOnPlane) sum -= residual[i](2, 0);
  return kWhole * sum;
}

CylinderFigures CylinderRun::measure(const State& state) const {
  const double radius = x_.diameter / 2;
  const Balance balance = newton_->balance(state);
  CylinderFigures f;
  f.force_N = force(state) * kNewtonPerMilli;
  f.half_width_middle_mm = state.x[node_at(mesh_, {radius, 0, 0})](0, 0);
  f.half_width_end_mm = state.x[node_at(mesh_, {radius, 0, end()})](0, 0);
  f.half_length_axis_mm = state.x[node_at(mesh_, {0, 0, end()})](2, 0);
  f.stored_energy_mJ = kEighths * balance.energy * kMilliJoulePerMicro;
  f.min_J = balance.min_J;
  f.max_J = balance.max_J;
  f.dof = dofs_.num_equations();
  f.elements = mesh_.num_elements();
  if (contact_)
    f.penetration_mm = contact_figures(*model_, state, *contact_, 0, contact_faces_).penetration;
  return f;
}

CylinderFigures CylinderRun::run() {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  State state = model_->rest();
  double work = 0, last_force = 0, last_fraction = 0;
  const LoadSteppingReport load = step_load(
      state, {1.0 / x_.steps, 1.0 / (64 * x_.steps), 2000, 1},
      [&](double fraction, State& s) { return equilibrate(fraction, s); },
      [&](double fraction, const State& s, const NewtonReport&) {
        const double now = force(s);
        work += (now + last_force) / 2 * 2 * (height(last_fraction) - height(fraction));
        last_force = now;
        last_fraction = fraction;
      });
  CylinderFigures figures = measure(state);
  figures.usable = load.complete();
  figures.reason = load.reason;
  figures.iterations = load.iterations;
  figures.plate_work_mJ = work * kMilliJoulePerMicro;
  figures.before = figures.after = file_;
  figures.after.mesh = HermiteMesh(state.x, mesh_.elements());
  figures.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  return figures;
}

}  // namespace

CylinderFigures squeeze_cylinder(const CylinderExperiment& experiment) {
  return CylinderRun(experiment).run();
}

}  // namespace mammotwin
