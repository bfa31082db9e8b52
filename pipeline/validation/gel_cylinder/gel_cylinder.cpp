#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>

#include "pipeline/validation/gel_cylinder/condition_number.h"
#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/load/load_stepping.h"
#include "solver/material/neo_hookean.h"
#include "solver/units.h"

namespace mammotwin {

namespace {

constexpr double kMilliJoulePerMicro = 1e-3;

void hold(const HermiteMesh& mesh, const FaceList& faces, int component, DofMap& dofs) {
  for (const auto& [e, face] : faces)
    for (int dof : face_dofs(mesh, e, face, component)) dofs.prescribe(dof);
}

/// The plane through 0 normal to `axis` is a mirror: across it x_axis is odd and the other
/// components are even, as in a C¹ mesh of the whole body.
void hold_mirror(const HermiteMesh& mesh, int axis, DofMap& dofs) {
  for (const auto& [e, face] : faces_in_plane(mesh, axis, 0)) {
    const int across = 1 << (face / 2);
    for (int i = 0; i < 3; ++i)
      for (int dof : face_dofs(mesh, e, face, i))
        dofs.prescribe(i == axis ? dof : dof + 3 * across);
  }
}

MeshFile part_of(const CylinderExperiment& x) {
  return cylinder_part(x.diameter, x.length, x.elements, x.part);
}

void check(const CylinderExperiment& x) {
  if (!(x.diameter > 0 && x.length > 0 && x.thickness > 0))
    throw std::invalid_argument("gel cylinder: diameter, length and thickness must be positive");
  const bool lying = x.how == CylinderCase::lateral || x.how == CylinderCase::plane_strain;
  if (x.part == CylinderPart::half && !lying)
    throw std::invalid_argument("gel cylinder: half of it is solved only lying");
  if (x.steps < 1 || x.contact_points < 4 || x.contact_points > 10)
    throw std::invalid_argument("gel cylinder: steps must be at least 1, contact points 4 to 10");
}

/// One run. The plate's normal is y (lateral, plane strain) or z (axial, bonded).
class CylinderRun {
 public:
  explicit CylinderRun(const CylinderExperiment& experiment)
      : x_(experiment), file_(part_of(experiment)), mesh_(file_.mesh), dofs_(mesh_) {
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
  double parts() const { return x_.part == CylinderPart::half ? 2 : 8; }  // in the cylinder

  void hold_symmetry();
  void hold_rigid_motion();
  void place_plate();
  NewtonReport equilibrate(double fraction, State& state);
  NewtonReport press(double unit, State& state);
  NewtonReport move_end(double fraction, State& state);
  double force(const State& state) const;
  double half_width(const State& state) const {
    return state.x[node_at(mesh_, {x_.diameter / 2, 0, 0})](0, 0);
  }
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
  hold_mirror(mesh_, 1, dofs_);
  if (x_.part == CylinderPart::half)
    hold_rigid_motion();
  else
    for (int axis : {0, 2}) hold_mirror(mesh_, axis, dofs_);
  const bool in_their_planes =
      x_.how == CylinderCase::plane_strain || x_.how == CylinderCase::axial;
  for (double z : {-end(), end()}) {
    const FaceList ends = faces_in_plane(mesh_, 2, z);
    for (int i = 0; i < 3; ++i)
      if (bonded() || (in_their_planes && i == 2)) hold(mesh_, ends, i, dofs_);
  }
}

/// The half may slide and turn on its plane of symmetry: two points on the axis hold it.
void CylinderRun::hold_rigid_motion() {
  const int middle = node_at(mesh_, {0, 0, 0}), at_end = node_at(mesh_, {0, 0, end()});
  for (int node : {middle, at_end}) dofs_.prescribe(dof_index(node, 0, 0));
  if (x_.how == CylinderCase::lateral) dofs_.prescribe(dof_index(middle, 0, 2));
}

void CylinderRun::place_plate() {
  penalties_.last = x_.penalty;
  penalties_.first = std::min(penalties_.first, x_.penalty);
  if (!by_contact()) return;
  contact_ = std::make_shared<PlateContact>();
  contact_->points1d = x_.contact_points;
  const Eigen::Vector3d normal = -Eigen::Vector3d::UnitY();
  contact_->plates = {Plate{-start() * normal, normal, Eigen::Vector3d::UnitX(), 0, true}};
  contact_faces_ = faces_with_label(file_, FaceLabel::skin);
  for (const auto& [e, face] : contact_faces_)
    model_->add_surface_potential(e, face, contact_, contact_->points1d);
}

NewtonReport CylinderRun::move_end(double fraction, State& state) {
  std::vector<HermiteMesh::Node> pending(mesh_.num_nodes(), HermiteMesh::Node::Zero());
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    if (std::abs(mesh_.node(i)(2, 0) - end()) < kOnPlane)
      pending[i](2, 0) = height(fraction) - state.x[i](2, 0);
  NewtonOptions homogeneous = penalties_.newton;
  homogeneous.keep_unstable = true;  // the closed form is, beyond a stretch of 0.68
  return newton_->solve(state, homogeneous, pending);
}

NewtonReport CylinderRun::press(double unit, State& state) {
  if (!x_.continued) {
    PenaltyOptions at_once = penalties_;
    at_once.first = at_once.last;
    State trial = state;
    const NewtonReport report = solve_contact(*newton_, *contact_, unit, at_once, trial);
    if (report.usable()) {
      state = std::move(trial);
      return report;
    }
  }
  return solve_contact(*newton_, *contact_, unit, penalties_, state);
}

NewtonReport CylinderRun::equilibrate(double fraction, State& state) {
  if (!by_contact()) return move_end(fraction, state);
  contact_->plates[0].point = -height(fraction) * contact_->plates[0].normal;
  const double size = std::cbrt(model_->volume() / mesh_.num_elements());
  NewtonReport report = press(2 * x_.c1 / size, state);
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
  const double whole = parts() / 2;  // parts that press on one plate
  if (by_contact())
    return whole * contact_figures(*model_, state, *contact_, 0, contact_faces_).force.norm();
  double sum = 0;
  const auto residual = newton_->assembler().nodal_residual(state);
  for (int i = 0; i < mesh_.num_nodes(); ++i)
    if (std::abs(mesh_.node(i)(2, 0) - end()) < kOnPlane) sum -= residual[i](2, 0);
  return whole * sum;
}

CylinderFigures CylinderRun::measure(const State& state) const {
  const double radius = x_.diameter / 2;
  const Balance balance = newton_->balance(state);
  CylinderFigures f;
  f.force_N = force(state) * kNewtonPerMilli;
  f.half_width_middle_mm = half_width(state);
  f.half_width_end_mm = state.x[node_at(mesh_, {radius, 0, end()})](0, 0);
  f.half_length_axis_mm = state.x[node_at(mesh_, {0, 0, end()})](2, 0);
  f.stored_energy_mJ = parts() * balance.energy * kMilliJoulePerMicro;
  f.min_J = balance.min_J;
  f.max_J = balance.max_J;
  f.dof = dofs_.num_equations();
  f.elements = mesh_.num_elements();
  if (x_.with_condition) f.condition = condition_number(*model_, dofs_, state);
  if (contact_)
    f.penetration_mm = contact_figures(*model_, state, *contact_, 0, contact_faces_).penetration;
  return f;
}

CylinderFigures CylinderRun::run() {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  State state = model_->rest();
  double work = 0, last_force = 0, last_fraction = 0;
  std::vector<CylinderStep> history;
  const LoadSteppingReport load = step_load(
      state, {1.0 / x_.steps, 1.0 / (64 * x_.steps), 2000, 1},
      [&](double fraction, State& s) { return equilibrate(fraction, s); },
      [&](const LoadSteppingReport& so_far, const State& s, const NewtonReport&) {
        const double fraction = so_far.reached;
        const double now = force(s);
        work += (now + last_force) / 2 * 2 * (height(last_fraction) - height(fraction));
        last_force = now;
        last_fraction = fraction;
        history.push_back({2 * height(fraction), now * kNewtonPerMilli, half_width(s)});
      });
  CylinderFigures figures = measure(state);
  figures.usable = load.complete();
  figures.reason = load.reason;
  figures.iterations = load.iterations;
  figures.plate_work_mJ = work * kMilliJoulePerMicro;
  figures.history = std::move(history);
  figures.before = figures.after = file_;
  figures.after.mesh = HermiteMesh(state.x, mesh_.elements());
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  return figures;
}

}  // namespace

CylinderElements even_elements(int n) { return {2 * n, (n + 1) / 2, n + 1}; }

CylinderFigures squeeze_cylinder(const CylinderExperiment& experiment) {
  return CylinderRun(experiment).run();
}

}  // namespace mammotwin
