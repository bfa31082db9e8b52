#include "solver/contact/plate_friction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mammotwin {

namespace {

using Eigen::Vector3d;

template <class Visit>
void for_points(const Model& model, const State& state, int points1d,
                const std::vector<std::pair<int, int>>& faces, Visit visit) {
  for (const auto& [e, number] : faces) {
    const auto x = model.coefficients(state.x, e);
    for (const Face& face : model.faces(e))
      for (int q = 0; face.face() == number && face.points1d() == points1d && q < face.num_points();
           ++q)
        visit(face.point(q), face.deformed(x, q).template head<3>());
  }
}

}  // namespace

PlateFriction::PlateFriction(std::shared_ptr<const PlateContact> contact, double coefficient,
                             double slip)
    : contact_(std::move(contact)), coefficient_(coefficient), slip_(slip) {
  if (!(coefficient > 0 && coefficient <= 1))
    throw std::invalid_argument("friction coefficient is " + std::to_string(coefficient) +
                                "; expected above 0 and at most 1");
  if (!(std::isfinite(slip) && slip > 0))
    throw std::invalid_argument("friction slip is " + std::to_string(slip) +
                                " mm; expected a positive length");
}

PlateFriction::SlipEnergy PlateFriction::energy(double s) const {
  if (reach_ > 0) return {s * s / (2 * reach_), 1 / reach_};
  if (s >= slip_) return {s - slip_ / 3, 1 / s};
  const double share = s / slip_;
  return {s * share * (1 - share / 3), (2 - share) / slip_};
}

/// D'(s) where D = s/h'(s).
double PlateFriction::ratio_slope(double s) const {
  if (reach_ > 0) return 0;
  if (s >= slip_) return 1;
  const double ratio = slip_ / (2 * slip_ - s);
  return ratio * ratio;
}

/// w + δw of w D(|s|) = s, linearised at a slip `from`, kept to its length of at most 1.
Vector3d PlateFriction::moved_share(const Vector3d& share, const Vector3d& from,
                                    const Vector3d& to) const {
  const double length = from.norm(), inverse_ratio = energy(length).slope_over_slip;
  Vector3d moved = inverse_ratio * to;
  if (length > 0)
    moved -= inverse_ratio * ratio_slope(length) * from.dot(to - from) / length * share;
  return moved / std::max(1.0, moved.norm());
}

const PlateFriction::Contact& PlateFriction::at(const SurfacePoint& point, int plate) const {
  return history_[point.index * contact_->plates.size() + plate];
}

Vector3d PlateFriction::slip(const Vector3d& x, const Contact& contact, const Plate& plate) const {
  const Vector3d moved = x - plate.from_local(contact.anchor);
  return moved - contact.normal.dot(moved) * contact.normal;
}

void PlateFriction::track(const Model& model, const State& state,
                          const std::vector<std::pair<int, int>>& faces, double share) {
  if (reach_ > 0) return;
  const std::size_t plates = contact_->plates.size();
  history_.resize(model.num_surface_points() * plates);
  for_points(
      model, state, contact_->points1d, faces, [&](const SurfacePoint& point, const Vector3d& x) {
        for (std::size_t p = 0; p < plates; ++p) {
          const Gap gap = contact_->plates[p].gap(x);
          Contact& contact = history_[point.index * plates + p];
          contact.normal = gap.normal.normalized();  // of smoothed facets it is no unit vector
          const double pressure = contact_->pressure(gap.gap);
          contact.pressure = share * pressure + (1 - share) * contact.pressure;
        }
      });
}

void PlateFriction::step(const Model& model, const State& from, const State& to,
                         const std::vector<std::pair<int, int>>& faces) {
  if (reach_ > 0) return;
  const std::size_t plates = contact_->plates.size();
  const bool first = shares_.empty();
  shares_.resize(model.num_surface_points() * plates);
  std::vector<Vector3d> starts(model.num_surface_points());
  for_points(model, from, contact_->points1d, faces,
             [&](const SurfacePoint& point, const Vector3d& x) { starts[point.index] = x; });
  for_points(model, to, contact_->points1d, faces,
             [&](const SurfacePoint& point, const Vector3d& x) {
               for (std::size_t p = 0; p < plates; ++p) {
                 const Contact& contact = at(point, static_cast<int>(p));
                 const Vector3d before = slip(starts[point.index], contact, contact_->plates[p]),
                                now = slip(x, contact, contact_->plates[p]);
                 Vector3d& share = shares_[point.index * plates + p];
                 if (first) share = energy(before.norm()).slope_over_slip * before;
                 share = contact.pressure > 0 ? moved_share(share, before, now)
                                              : (energy(now.norm()).slope_over_slip * now).eval();
               }
             });
}

void PlateFriction::commit(const Model& model, const State& state,
                           const std::vector<std::pair<int, int>>& faces) {
  if (reach_ > 0) return;
  const bool first = history_.empty();
  track(model, state, faces);
  const std::size_t plates = contact_->plates.size();
  for_points(model, state, contact_->points1d, faces,
             [&](const SurfacePoint& point, const Vector3d& x) {
               for (std::size_t p = 0; p < plates; ++p) {
                 const Plate& plate = contact_->plates[p];
                 Contact& contact = history_[point.index * plates + p];
                 const Vector3d s = slip(x, contact, plate);
                 if (first || contact.pressure == 0)
                   contact.anchor = plate.to_local(x);
                 else if (s.norm() > slip_)
                   contact.anchor = plate.to_local(x - slip_ * s.normalized());
               }
             });
}

std::vector<PlateFriction::Hold> PlateFriction::holds(
    const Model& model, const State& state, const std::vector<std::pair<int, int>>& faces) const {
  std::vector<Hold> all;
  for_points(model, state, contact_->points1d, faces,
             [&](const SurfacePoint& point, const Vector3d& x) {
               for (std::size_t p = 0; p < contact_->plates.size(); ++p) {
                 const int number = static_cast<int>(p);
                 const Contact& contact = at(point, number);
                 if (contact.pressure == 0) continue;
                 const Vector3d s = slip(x, contact, contact_->plates[p]);
                 all.push_back({point.index, number, x - s, contact.pressure, reach_});
               }
             });
  return all;
}

void PlateFriction::hold(const std::vector<Hold>& holds, const Model& model, const State& state,
                         const std::vector<std::pair<int, int>>& faces) {
  const int points = model.num_surface_points(), plates = static_cast<int>(contact_->plates.size());
  history_.clear();
  reach_ = 0;
  commit(model, state, faces);
  for (Contact& contact : history_) contact.pressure = 0;
  for (const Hold& hold : holds) {
    if (hold.point < 0 || hold.point >= points || hold.plate < 0 || hold.plate >= plates)
      throw std::invalid_argument("a point that friction holds belongs to another mesh");
    Contact& contact = history_[hold.point * plates + hold.plate];
    contact.anchor = contact_->plates[hold.plate].to_local(hold.anchor);
    contact.pressure = hold.pressure;
    reach_ = hold.reach;
  }
}

void PlateFriction::freeze(double reach, const Model& model, const State& state,
                           const std::vector<std::pair<int, int>>& faces) {
  if (reach_ > 0) return;
  for_points(model, state, contact_->points1d, faces,
             [&](const SurfacePoint& point, const Vector3d& x) {
               for (std::size_t p = 0; p < contact_->plates.size(); ++p) {
                 const Plate& plate = contact_->plates[p];
                 Contact& contact = history_[point.index * contact_->plates.size() + p];
                 if (contact.pressure == 0) continue;
                 const Vector3d s = slip(x, contact, plate);
                 contact.anchor = plate.to_local(x - reach * energy(s.norm()).slope_over_slip * s);
               }
             });
  reach_ = reach;
}

Vector3d PlateFriction::traction(const Vector3d& x, const SurfacePoint& point, int plate) const {
  const Contact& contact = at(point, plate);
  if (contact.pressure == 0) return Vector3d::Zero();
  const Vector3d s = slip(x, contact, contact_->plates[plate]);
  return -coefficient_ * contact.pressure * energy(s.norm()).slope_over_slip * s;
}

bool PlateFriction::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                            int order, SurfaceResponse& response) const {
  bool touches = false;
  for (std::size_t p = 0; p < contact_->plates.size(); ++p) {
    const Contact& contact = at(point, static_cast<int>(p));
    if (contact.pressure == 0) continue;
    if (!touches) {
      response.energy = 0;
      response.gradient.head<3>().setZero();
      response.hessian.topLeftCorner<3, 3>().setZero();
    }
    touches = true;
    const double limit = coefficient_ * contact.pressure;
    const Vector3d s = slip(y.head<3>(), contact, contact_->plates[p]);
    const double length = s.norm();
    const SlipEnergy h = energy(length);
    response.energy += limit * h.energy;
    response.gradient.head<3>() += limit * h.slope_over_slip * s;
    if (order < 2) continue;
    auto hessian = response.hessian.topLeftCorner<3, 3>();
    hessian += limit * h.slope_over_slip *
               (Eigen::Matrix3d::Identity() - contact.normal * contact.normal.transpose());
    if (length == 0) continue;
    const Vector3d share = shares_.empty() ? (h.slope_over_slip * s).eval()
                                           : shares_[point.index * contact_->plates.size() + p];
    hessian -= limit * h.slope_over_slip * ratio_slope(length) / (2 * length) *
               (share * s.transpose() + s * share.transpose());
  }
  return touches;
}

bool PlateFriction::circulation(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point,
                                Eigen::Matrix3d& derivative) const {
  if (reach_ > 0) return false;
  bool any = false;
  for (std::size_t p = 0; p < contact_->plates.size(); ++p) {
    const Contact& contact = at(point, static_cast<int>(p));
    if (contact.pressure == 0) continue;
    if (!any) derivative.setZero();
    any = true;
    const Vector3d s = slip(y.head<3>(), contact, contact_->plates[p]);
    derivative -= coefficient_ * contact_->penalty * energy(s.norm()).slope_over_slip * s *
                  contact.normal.transpose();
  }
  return any;
}

Following following(PlateFriction& friction, const Model& model,
                    const std::vector<std::pair<int, int>>& faces) {
  return {[&](const State& s, double share) { friction.track(model, s, faces, share); },
          [&](const State& from, const State& to) { friction.step(model, from, to, faces); },
          [&] { friction.align(); }};
}

}  // namespace mammotwin
