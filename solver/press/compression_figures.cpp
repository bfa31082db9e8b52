#include "solver/press/compression_figures.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "solver/contact/pressed_gap.h"
#include "solver/element/tensor_basis.h"
#include "solver/units.h"

namespace mammotwin {

namespace {

constexpr double kCm2PerMm2 = 1e-2;

/// Most that the chest-wall face came nearer to or farther from its surface [mm].
double wall_gap(const Press& press, const BreastModel& breast, const State& state) {
  if (!breast.wall) return 0;
  double largest = 0;
  for (const auto& [e, number] : breast.wall_faces) {
    const auto x = press.model().coefficients(state.x, e);
    for (const Face& face : press.model().faces(e))
      for (int q = 0; face.face() == number && q < face.num_points(); ++q)
        largest = std::max(largest, std::abs(breast.wall->gap(face.deformed(x, q).head<3>()).gap -
                                             breast.wall->gap(face.point(q).X).gap));
  }
  return largest;
}

/// Of the tissue in front of the plates' edges [mm³], in reference volume.
double volume_in_front(const Press& press, const std::vector<HermiteMesh::Node>& nodes) {
  const HermiteMesh shape(nodes, press.problem().mesh.mesh.elements());
  const auto& t = hermite_table().points;
  double volume = 0;
  for (int e = 0; e < press.model().num_elements(); ++e)
    for (int q = 0; q < kPoints; ++q) {
      const Eigen::Vector3d x = shape.position({e, {t[q & 3], t[q >> 2 & 3], t[q >> 4]}});
      if (press.problem().plates.depth.dot(x) > press.placed().edge)
        volume += press.model().element(e).point_weight(q);
    }
  return volume;
}

/// Fraction of the quadrature points with J in [0.5, 1.5].
double J_within_half(const Model& model, const State& state) {
  int within = 0;
  for (int e = 0; e < model.num_elements(); ++e)
    for (const auto& F : model.element(e).deformation_gradients(model.coefficients(state.x, e)))
      within += F.determinant() >= 0.5 && F.determinant() <= 1.5;
  return within / double(kPoints * model.num_elements());
}

/// 95th percentile, of both plates together [mm].
double pressed_gap(const Press& press, const State& state) {
  constexpr double kShare = 0.95;
  const PlateContact& contact = *press.breast().contact;
  std::vector<WeighedGap> gaps;
  for (const Plate& plate : contact.plates) {
    const auto more =
        pressed_gaps(press.model(), state, plate, press.breast().contact_faces, contact.points1d);
    gaps.insert(gaps.end(), more.begin(), more.end());
  }
  return gap_percentile(std::move(gaps), kShare);
}

}  // namespace

double retained_fraction(const Press& press, const State& state) {
  return volume_in_front(press, state.x) / volume_in_front(press, press.positioned());
}

bool slipped_out(const Press& press, const State& state) {
  return retained_fraction(press, state) < press.options().least_retained;
}

void measure_compression(const Press& press, const State& state, CompressionReport& report) {
  const Balance balance = press.newton().balance(state);
  report.thickness_mm = press.thickness(state);
  report.force_N = press.paddle_force(state);
  report.paddle_tilt_deg = press.placed().paddle_tilt;
  report.contact_area_cm2 = press.figures(state, Press::kPaddle).area * kCm2PerMm2;
  report.gap_p95_mm = pressed_gap(press, state);
  report.volume_change = balance.deformed_volume / press.model().volume() - 1;
  report.min_J = balance.min_J;
  report.max_J = balance.max_J;
  report.J_within_half = J_within_half(press.model(), state);
  report.mean_gap_mm = press.mean_gap(state);
  report.max_penetration_mm = press.penetration(state);
  report.imbalance = balance.residual.norm() / balance.flow;
  report.retained_fraction = retained_fraction(press, state);
  report.slipped_out = slipped_out(press, state);
  report.wall_gap_mm = wall_gap(press, press.breast(), state);
}

double force_from_energy(Press& press, const State& state) {
  press.breast().contact->follow = {};
  constexpr double nudge = 1e-3;    // [mm]: small beside penetrations, so that contact stays
  constexpr double balance = 1e-4;  // residual: the energy errs by its square
  const PlacedPlates placed = press.placed();
  double energy[2];
  for (int side = 0; side < 2; ++side) {
    State nudged = state;
    press.move_paddle(placed.paddle_height + (side ? nudge : -nudge), placed.paddle_tilt);
    const NewtonReport report = press.resettle(nudged, balance);
    energy[side] = report.usable() ? press.newton().balance(nudged).energy
                                   : std::numeric_limits<double>::quiet_NaN();
  }
  press.put(placed);
  return (energy[0] - energy[1]) / (2 * nudge) * kNewtonPerMilli;
}

}  // namespace mammotwin
