#include "pipeline/validation/lagrange/lagrange_cylinder.h"

#include <cmath>
#include <ctime>
#include <stdexcept>

#include "pipeline/validation/lagrange/lagrange_newton.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/material/neo_hookean.h"
#include "solver/units.h"

namespace mammotwin {

namespace {

constexpr double kOnPlane = 1e-6;  // [mm]

std::vector<bool> held_dofs(const LagrangeMesh& mesh, const CylinderExperiment& x) {
  std::vector<bool> held(3 * mesh.X.size(), false);
  for (std::size_t n = 0; n < mesh.X.size(); ++n) {
    for (int i = 0; i < 3; ++i) held[3 * n + i] = std::abs(mesh.X[n][i]) < kOnPlane;
    if (x.how == CylinderCase::plane_strain && std::abs(mesh.X[n].z() - x.length / 2) < kOnPlane)
      held[3 * n + 2] = true;
  }
  return held;
}

std::size_t nearest(const LagrangeMesh& mesh, const Eigen::Vector3d& X) {
  std::size_t best = 0;
  for (std::size_t n = 1; n < mesh.X.size(); ++n)
    if ((mesh.X[n] - X).norm() < (mesh.X[best] - X).norm()) best = n;
  return best;
}

void add(NewtonReport& total, const NewtonReport& part) {
  total.iterations += part.iterations;
  total.converged = part.converged;
  total.reason = part.reason;
}

/// One squeeze: penalties as in penalty_continuation.h.
class Run {
 public:
  Run(const CylinderExperiment& x, int order)
      : x_(x),
        file_(cylinder_part(x.diameter, x.length, x.elements, x.part)),
        mesh_(file_.mesh, LagrangeElement(order)),
        model_(
            mesh_.broken(mesh_.X), [&](const Eigen::Vector3d&, double) { return gel_; },
            SolidOptions{mesh_.element.pressure(), 1e6, 0}),
        newton_(mesh_, model_, held_dofs(mesh_, x)),
        skin_(faces_with_label(file_, FaceLabel::skin)),
        state_{mesh_.X, std::vector<double>(8 * mesh_.elements.size(), 0.0)} {
    const Eigen::Vector3d normal = -Eigen::Vector3d::UnitY();
    contact_->points1d = x.contact_points;
    contact_->plates = {
        Plate{-x.thickness / 2 * normal, normal, Eigen::Vector3d::UnitX(), 0, true}};
    for (const auto& [e, face] : skin_)
      model_.add_surface_potential(e, face, contact_, contact_->points1d);
  }

  CylinderFigures squeeze();

 private:
  NewtonReport equilibrate();
  ContactFigures plate() const {
    return contact_figures(model_, newton_.hermite(state_), *contact_, 0, skin_);
  }

  const CylinderExperiment& x_;
  std::shared_ptr<const Material> gel_ = std::make_shared<NeoHookean>(x_.c1);
  MeshFile file_;
  LagrangeMesh mesh_;
  Model model_;
  LagrangeNewton newton_;
  FaceList skin_;
  LagrangeNewton::State state_;
  std::shared_ptr<PlateContact> contact_ = std::make_shared<PlateContact>();
};

NewtonReport Run::equilibrate() {
  constexpr int most = 60, most_rounds = 8;
  constexpr double near = 1e-2, close = 1e-7, growth = 3;
  const PenaltyOptions penalties;  // these elements need it raised from soft to stiff
  const double unit = 2 * x_.c1 / std::cbrt(model_.volume() / model_.num_elements());
  NewtonReport total;
  for (double factor = penalties.first; factor < penalties.last * (1 - 1e-9);
       factor *= penalties.growth) {
    contact_->penalty = factor * unit;
    add(total, newton_.solve(state_, most, near));
    if (!total.usable()) return total;
  }
  contact_->penalty = penalties.last * unit;
  for (int round = 0; round < most_rounds; ++round, contact_->penalty *= growth) {
    add(total, newton_.solve(state_, most, close));
    if (!total.usable() || plate().penetration <= x_.gap_tolerance) return total;
  }
  return total;
}

CylinderFigures Run::squeeze() {
  const std::clock_t cpu = std::clock();
  const NewtonReport report = equilibrate();
  const double end = x_.length / 2, radius = x_.diameter / 2;
  CylinderFigures f;
  f.usable = report.usable();
  f.reason = report.reason;
  f.iterations = report.iterations;
  f.cpu_seconds = double(std::clock() - cpu) / CLOCKS_PER_SEC;
  const ContactFigures on_plate = plate();
  f.force_N = 4 * on_plate.force.norm() * kNewtonPerMilli;  // a quarter of the plate is modelled
  f.penetration_mm = on_plate.penetration;
  f.half_width_middle_mm = state_.x[nearest(mesh_, {radius, 0, 0})].x();
  f.half_width_end_mm = state_.x[nearest(mesh_, {radius, 0, end})].x();
  f.half_length_axis_mm = state_.x[nearest(mesh_, {0, 0, end})].z();
  f.dof = newton_.num_equations();
  f.elements = model_.num_elements();
  f.before = f.after = file_;
  f.before.mesh = mesh_.broken(mesh_.X);
  f.after.mesh = mesh_.broken(state_.x);
  return f;
}

}  // namespace

CylinderFigures squeeze_lagrange_cylinder(const CylinderExperiment& experiment, int order) {
  if (experiment.how != CylinderCase::lateral && experiment.how != CylinderCase::plane_strain)
    throw std::invalid_argument("Lagrange gel cylinder: only lying on its side");
  if (experiment.part != CylinderPart::eighth)
    throw std::invalid_argument("Lagrange gel cylinder: only an eighth of it");
  return Run(experiment, order).squeeze();
}

}  // namespace mammotwin
