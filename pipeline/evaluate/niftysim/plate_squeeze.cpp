#include "pipeline/evaluate/niftysim/plate_squeeze.h"

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/niftysim/roll_hold.h"
#include "pipeline/synthesize/mean_fractions.h"
#include "solver/contact/contact_figures.h"
#include "solver/contact/penalty_continuation.h"
#include "solver/element/skin_membrane.h"
#include "solver/load/load_stepping.h"
#include "solver/material/mixture.h"
#include "solver/material/neo_hookean.h"
#include "solver/units.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

constexpr int kAcross = 0, kDepth = 2;    // components of the file's frame
constexpr double kGapTolerance = 0.05;    // [mm]
constexpr double kRollTolerance = 5e-3;   // [rad]: 0.3 mm at the rim
constexpr double kCoupleTolerance = 0.5;  // [N mm], of some 50
constexpr int kMostRollRounds = 40;

FaceList faces_labelled(const MeshFile& mesh, FaceLabel label) {
  FaceList faces;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (mesh.faces[e][face] == label) faces.push_back({e, face});
  return faces;
}

class PlateSqueeze {
 public:
  PlateSqueeze(const MeshFile& mesh, const NiftySimModel& model, const Volume<Fractions>& tissue,
               const SqueezeOptions& options)
      : mesh_(mesh), file_(model), options_(options), dofs_(mesh.mesh) {
    make_model(tissue);
    hold();
    newton_ = std::make_unique<Newton>(*model_, dofs_);
  }
  Squeeze run();

 private:
  void make_model(const Volume<Fractions>& tissue);
  void hold();
  void load(double fraction);
  std::vector<Vector3d> base(const std::vector<HermiteMesh::Node>& nodes) const;
  NewtonReport settle_roll(State& state);
  double couple(const State& state) const;
  double penetration(const State& state) const;
  NewtonReport equilibrate(double fraction, State& state);
  void centre(std::vector<HermiteMesh::Node>& nodes) const;

  const MeshFile& mesh_;
  const NiftySimModel& file_;
  SqueezeOptions options_;
  DofMap dofs_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<Newton> newton_;
  std::shared_ptr<PlateContact> contact_ = std::make_shared<PlateContact>();
  std::shared_ptr<RollHold> roll_hold_ = std::make_shared<RollHold>();
  FaceList skin_, wall_;
  std::vector<MeshPoint> base_points_;  ///< the file's fixed nodes
  double polar_moment_ = 0;             ///< ∫ distance² from the axis of roll dV [mm^5]
  double spin_ = 0;                     ///< body force per distance from that axis [mN/mm^4]
  PenaltyOptions penalties_;
};

void PlateSqueeze::make_model(const Volume<Fractions>& tissue) {
  const auto law = [&](int set) {
    return std::make_shared<NeoHookean>(file_.sets[set].shear_modulus / 2);  // c1 = mu / 2
  };
  const Mixture::Laws laws{law(0), law(1), law(2)};
  const MeanFractions mean(tissue);
  const double bulk_ratio = file_.sets[0].bulk_modulus / file_.sets[0].shear_modulus;
  model_ = std::make_unique<Model>(
      mesh_.mesh,
      [&](const Vector3d& x, double volume) {
        const Fractions f = mean.at(x, volume);
        return mix(Mixing::geometric, {f.fat, f.fibroglandular, f.lesion}, laws);
      },
      SolidOptions{PressureSpace::trilinear, bulk_ratio, options_.grad_div});
  skin_ = faces_labelled(mesh_, FaceLabel::skin);
  wall_ = faces_labelled(mesh_, FaceLabel::chest_wall);
  const InverseMap locate(mesh_.mesh);
  for (const int n : file_.fixed_nodes) {
    base_points_.push_back(locate.nearest(file_.nodes[n]));
    roll_hold_->centre += mesh_.mesh.position(base_points_.back()) / file_.fixed_nodes.size();
  }
  if (options_.skin_thickness > 0) {
    // Under the membrane the volume's points are fat already.
    const double c1 = (file_.sets[2].shear_modulus - file_.sets[0].shear_modulus) / 2;
    const auto membrane = std::make_shared<SkinMembrane>(c1, options_.skin_thickness);
    for (const auto& [e, face] : skin_) model_->add_surface_potential(e, face, membrane);
  }
  for (int e = 0; e < model_->num_elements(); ++e)
    for (int q = 0; q < kPoints; ++q)
      polar_moment_ +=
          model_->element(e).point_weight(q) *
          (model_->element(e).point_position(q) - roll_hold_->centre).head<2>().squaredNorm();
  contact_->points1d = 8;
  for (const auto& [e, face] : skin_)
    model_->add_surface_potential(e, face, contact_, contact_->points1d);
}

void PlateSqueeze::hold() {
  for (const auto& [e, face] : wall_)
    for (const int dof : face_dofs(mesh_.mesh, e, face, kDepth)) dofs_.prescribe(dof);
  if (options_.roll)
    for (const auto& [e, face] : wall_) model_->add_surface_potential(e, face, roll_hold_);
  else
    dofs_.prescribe(dof_index(0, 0, kAcross));
  for (const ParameterTie& t : mesh_.ties)
    for (int i = 0; i < 3; ++i)
      dofs_.tie(dof_index(t.node, t.parameter, i), dof_index(t.to_node, t.to_parameter, i),
                t.factor);
  dofs_.number(mesh_.mesh);
}

void PlateSqueeze::load(double fraction) {
  contact_->plates.clear();
  for (const auto& plate : file_.plates)
    contact_->plates.push_back(Plate{plate.corner + fraction * plate.displacement,
                                     plate.displacement.normalized(), Vector3d::UnitZ(), 0, true});
  const Vector3d weight = options_.gravity ? (fraction * file_.density * file_.gravity).eval()
                                           : Vector3d::Zero().eval();
  const Eigen::AngleAxisd turned(roll_hold_->roll, Vector3d::UnitZ());
  model_->set_body_force([=, spin = spin_, centre = roll_hold_->centre](const Vector3d& X) {
    return (weight + spin * Vector3d::UnitZ().cross(turned * (X - centre))).eval();
  });
}

std::vector<Vector3d> PlateSqueeze::base(const std::vector<HermiteMesh::Node>& nodes) const {
  const HermiteMesh mesh(nodes, mesh_.mesh.elements());
  std::vector<Vector3d> x;
  for (const MeshPoint& p : base_points_) x.push_back(mesh.position(p));
  return x;
}

/// Turns the springs until the face's roll is the one asked. Their rest shape follows the face's
/// own deformation, and the couple that they are left with becomes the inertia of a roll that
/// speeds up, so that in the end they carry nothing.
NewtonReport PlateSqueeze::settle_roll(State& state) {
  const std::vector<Vector3d> X = base(mesh_.mesh.nodes());
  NewtonReport all;
  all.converged = true;
  for (int round = 0; round < kMostRollRounds; ++round) {
    std::vector<Vector3d> x = base(state.x);
    const double roll = roll_of(X, x);
    const Eigen::AngleAxisd back(-roll, Vector3d::UnitZ());
    for (Vector3d& p : x) p = roll_hold_->centre + back * (p - roll_hold_->centre);
    const double springs = couple(state);
    if (round > 0 && std::abs(roll - *options_.roll) < kRollTolerance &&
        std::abs(springs) < kCoupleTolerance)
      return all;
    roll_hold_->map = PlaneMap(X, x, roll_hold_->centre);
    spin_ += springs / kNewtonPerMilli / polar_moment_;
    load(1);
    const NewtonReport report = resettle(*newton_, *contact_, penalties_.newton, state);
    all.iterations += report.iterations;
    if (!report.usable()) return report;
  }
  return all;
}

/// About z, of the springs on the breast [N mm].
double PlateSqueeze::couple(const State& state) const {
  double sum = 0;
  for (const auto& [e, number] : wall_) {
    const auto x = model_->coefficients(state.x, e);
    for (const Face& face : model_->faces(e))
      for (int q = 0; face.face() == number && q < face.num_points(); ++q) {
        const Vector3d at = face.deformed(x, q).head<3>(), r = at - roll_hold_->centre;
        const Eigen::Vector2d f = face.point(q).area * roll_hold_->force(face.point(q).X, at);
        sum += r.x() * f.y() - r.y() * f.x();
      }
  }
  return sum * kNewtonPerMilli;
}

double PlateSqueeze::penetration(const State& state) const {
  double largest = 0;
  for (int plate = 0; plate < 2; ++plate)
    largest =
        std::max(largest, contact_figures(*model_, state, *contact_, plate, skin_).penetration);
  return largest;
}

NewtonReport PlateSqueeze::equilibrate(double fraction, State& state) {
  roll_hold_->roll = fraction * options_.roll.value_or(0);
  roll_hold_->map = {};
  spin_ = 0;
  load(fraction);
  const double size = std::cbrt(model_->volume() / mesh_.mesh.num_elements());
  NewtonReport report =
      solve_contact(*newton_, *contact_, file_.sets[1].shear_modulus / size, penalties_, state);
  if (!report.usable() || fraction < 1) return report;
  const NewtonReport last = close_gap(
      *newton_, *contact_, kGapTolerance, [&](const State& s) { return penetration(s); },
      penalties_.newton, state);
  report.iterations += last.iterations;
  if (!options_.roll) return report;
  const NewtonReport rolled = settle_roll(state);
  report.iterations += rolled.iterations;
  report.converged = rolled.converged;
  report.reason = rolled.reason;
  return report;
}

/// Density is uniform, so the centre of mass is the volume's.
void PlateSqueeze::centre(std::vector<HermiteMesh::Node>& nodes) const {
  double moved = 0;
  for (int e = 0; e < model_->num_elements(); ++e) {
    const auto share = model_->element(e).integrate(
        [](const Vector3d&) -> Vector3d { return Vector3d::Unit(kAcross); });
    const SolidElement::Coefficients u =
        model_->coefficients(nodes, e) - model_->coefficients(mesh_.mesh.nodes(), e);
    moved += u.cwiseProduct(share).sum();
  }
  for (auto& node : nodes) node(kAcross, 0) -= moved / model_->volume();
}

Squeeze PlateSqueeze::run() {
  const auto begin = std::chrono::steady_clock::now();
  State state = model_->rest();
  LoadSteppingOptions steps;
  steps.first_step = 0.5;  // half way the breast has hardly begun to roll
  const LoadSteppingReport report = step_load(
      state, steps, [&](double fraction, State& s) { return equilibrate(fraction, s); },
      [](const LoadSteppingReport&, const State&, const NewtonReport&) {});
  const Balance balance = newton_->balance(state);
  Squeeze squeeze;
  squeeze.reason = report.complete() ? "" : report.reason;
  squeeze.dof = dofs_.num_equations();
  squeeze.steps = report.steps;
  squeeze.iterations = report.iterations;
  squeeze.min_J = balance.min_J, squeeze.max_J = balance.max_J;
  squeeze.volume_change = balance.deformed_volume / model_->volume() - 1;
  squeeze.penetration_mm = penetration(state);
  squeeze.force_N =
      contact_figures(*model_, state, *contact_, 0, skin_).force.norm() * kNewtonPerMilli;
  squeeze.roll = roll_of(base(mesh_.mesh.nodes()), base(state.x));
  squeeze.couple_N_mm = spin_ * polar_moment_ * kNewtonPerMilli;
  squeeze.deformed = state.x;
  centre(squeeze.deformed);
  squeeze.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return squeeze;
}

}  // namespace

Squeeze squeeze_between_plates(const MeshFile& mesh, const NiftySimModel& model,
                               const Volume<Fractions>& tissue, const SqueezeOptions& options) {
  return PlateSqueeze(mesh, model, tissue, options).run();
}

}  // namespace mammotwin
