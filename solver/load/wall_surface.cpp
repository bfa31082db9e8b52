#include "solver/load/wall_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/face.h"

namespace mammotwin {

namespace {

constexpr int kProjectionSteps = 30;  // Newton converges in 3 to 6
constexpr int kHalvings = 8;  // of a step that leads away from the point: Newton alone can cycle
constexpr double kRimTolerance = 1e-9;

/// Hermite functions continued by their tangents outside [0, 1], so that the surface is.
HermiteValues extended(double t, int order) {
  const double end = std::clamp(t, 0.0, 1.0);
  if (t == end) return hermite_derivatives(t, order);
  const HermiteValues slope = hermite_derivatives(end, 1);
  if (order == 1) return slope;
  if (order == 2) return {0, 0, 0, 0};
  HermiteValues value = hermite_derivatives(end, 0);
  for (int i = 0; i < 4; ++i) value[i] += slope[i] * (t - end);
  return value;
}

struct SurfaceJet {
  Eigen::Vector3d s, s1, s2, s11, s12, s22;
};

Eigen::Vector3d combine(const Eigen::Matrix<double, 3, 16>& c, const HermiteValues& h,
                        const HermiteValues& g) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int a = 0; a < 16; ++a) sum += h[a & 3] * g[a >> 2] * c.col(a);
  return sum;
}

SurfaceJet jet(const Eigen::Matrix<double, 3, 16>& c, const Eigen::Vector2d& xi) {
  HermiteValues h[3], g[3];
  for (int order = 0; order < 3; ++order) {
    h[order] = extended(xi[0], order);
    g[order] = extended(xi[1], order);
  }
  return {combine(c, h[0], g[0]), combine(c, h[1], g[0]), combine(c, h[0], g[1]),
          combine(c, h[2], g[0]), combine(c, h[1], g[1]), combine(c, h[0], g[2])};
}

/// Newton step towards the foot of x; falls back on Gauss-Newton where the distance is not convex.
Eigen::Vector2d foot_step(const SurfaceJet& j, const Eigen::Vector3d& x) {
  const Eigen::Vector3d r = x - j.s;
  const Eigen::Vector2d gradient(r.dot(j.s1), r.dot(j.s2));
  Eigen::Matrix2d metric, curvature;
  metric << j.s1.dot(j.s1), j.s1.dot(j.s2), j.s1.dot(j.s2), j.s2.dot(j.s2);
  curvature << r.dot(j.s11), r.dot(j.s12), r.dot(j.s12), r.dot(j.s22);
  const Eigen::Matrix2d hessian = metric - curvature;
  const bool convex = hessian(0, 0) > 0 && hessian.determinant() > 0.01 * metric.determinant();
  const Eigen::Vector2d step = (convex ? hessian : metric).inverse() * gradient;
  return step * std::min(1.0, 0.5 / std::max(step.cwiseAbs().maxCoeff(), 1e-300));
}

/// Box of the patch's Bézier points, whose hull it lies in: value ± slope/3 at each end, both ways.
Eigen::AlignedBox3d bezier_box(const Eigen::Matrix<double, 3, 16>& c) {
  const auto point = [](int i, int t) {  // weight of one-dimensional function t in Bézier point i
    const int end = i / 2;
    if (t / 2 != end) return 0.0;
    if (t % 2 == 0) return 1.0;
    return i == 1 ? 1.0 / 3 : i == 2 ? -1.0 / 3 : 0.0;
  };
  Eigen::AlignedBox3d box;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      Eigen::Vector3d b = Eigen::Vector3d::Zero();
      for (int a = 0; a < 16; ++a) b += point(i, a & 3) * point(j, a >> 2) * c.col(a);
      box.extend(b);
    }
  return box;
}

int stride(int direction) { return direction == 0 ? 1 : direction == 1 ? 4 : 16; }

}  // namespace

std::pair<int, int> face_parameter(const HermiteMesh& mesh, int element, int face, int a) {
  const auto [d1, d2] = face_directions(face);
  const int f = 2 * (face % 2) * stride(face / 2) + (a & 3) * stride(d1) + (a >> 2) * stride(d2);
  return {mesh.corners(element)[corner_of_function(f)], parameter_of_function(f)};
}

Eigen::Matrix<double, 3, 16> face_coefficients(const HermiteMesh& mesh, int element, int face) {
  Eigen::Matrix<double, 3, 16> coefficients;
  for (int a = 0; a < 16; ++a) {
    const auto [node, parameter] = face_parameter(mesh, element, face, a);
    coefficients.col(a) = mesh.node(node).col(parameter);
  }
  return coefficients;
}

WallSurface::WallSurface(const HermiteMesh& mesh, const std::vector<std::pair<int, int>>& faces) {
  if (faces.empty()) throw std::invalid_argument("the chest wall has no faces");
  for (const auto& [element, face] : faces) {
    Patch patch;
    patch.coefficients = face_coefficients(mesh, element, face);
    for (int k = 0; k < kSamples1d * kSamples1d; ++k) {
      const Eigen::Vector2d xi(k % kSamples1d, k / kSamples1d);
      patch.samples.col(k) = jet(patch.coefficients, xi / (kSamples1d - 1.0)).s;
    }
    const double outward = (face / 2 == 1 ? -1 : 1) * (face % 2 ? 1 : -1);
    patch.orientation = -outward;
    patch.box = bezier_box(patch.coefficients);
    patches_.push_back(patch);
  }
}

WallSurface::Foot WallSurface::project_from(const Patch& patch, Eigen::Vector2d xi,
                                            const Eigen::Vector3d& x) const {
  SurfaceJet here = jet(patch.coefficients, xi);
  for (int step = 0; step < kProjectionSteps; ++step) {
    Eigen::Vector2d delta = foot_step(here, x);
    const double distance = (x - here.s).norm();
    SurfaceJet there = jet(patch.coefficients, xi + delta);
    for (int halving = 0; halving < kHalvings && (x - there.s).norm() > distance; ++halving) {
      delta /= 2;
      there = jet(patch.coefficients, xi + delta);
    }
    xi += delta;
    here = there;
    if (delta.cwiseAbs().maxCoeff() < 1e-14) break;
  }
  const Eigen::Vector2d clamped = xi.cwiseMax(0).cwiseMin(1);
  return {&patch, xi, (x - jet(patch.coefficients, clamped).s).norm(),
          (xi - clamped).cwiseAbs().maxCoeff() <= kRimTolerance};
}

/// From every sample that is nearer than its neighbours.
WallSurface::Foot WallSurface::project(const Patch& patch, const Eigen::Vector3d& x) const {
  const Eigen::Array<double, 1, kSamples1d* kSamples1d> flat =
      (patch.samples.colwise() - x).colwise().squaredNorm();
  const Eigen::Map<const Eigen::Array<double, kSamples1d, kSamples1d>> grid(flat.data());
  Foot best{nullptr, {}, 0, false};
  for (int j = 0; j < kSamples1d; ++j)
    for (int i = 0; i < kSamples1d; ++i) {
      const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, kSamples1d - 1);
      const int j0 = std::max(j - 1, 0), j1 = std::min(j + 1, kSamples1d - 1);
      if (grid(i, j) > grid.block(i0, j0, i1 - i0 + 1, j1 - j0 + 1).minCoeff()) continue;
      const Foot foot = project_from(patch, Eigen::Vector2d(i, j) / (kSamples1d - 1.0), x);
      if (!best.patch || foot.distance < best.distance) best = foot;
    }
  return best;
}

/// Patches are asked in the order of their boxes' distance, until no box is nearer than a foot.
WallSurface::Foot WallSurface::nearest_foot(const Eigen::Vector3d& x) const {
  static thread_local std::vector<std::pair<double, const Patch*>> order;
  order.clear();
  for (const Patch& patch : patches_) order.push_back({patch.box.exteriorDistance(x), &patch});
  std::sort(order.begin(), order.end());
  Foot best{nullptr, {}, 0, false};
  for (const auto& [at_least, patch] : order) {
    if (best.patch && at_least > best.distance + kRimTolerance) break;
    const Foot foot = project(*patch, x);
    const double lead = best.distance - foot.distance;
    const bool better = !best.patch || lead > kRimTolerance ||
                        (std::abs(lead) <= kRimTolerance && foot.inside && !best.inside);
    if (better) best = foot;
  }
  return best;
}

Gap WallSurface::gap(const Eigen::Vector3d& x) const {
  const Foot foot = nearest_foot(x);
  const SurfaceJet j = jet(foot.patch->coefficients, foot.xi);
  const Eigen::Vector3d n = foot.patch->orientation * j.s1.cross(j.s2).normalized();
  const double g = n.dot(x - j.s);
  // Weingarten: ∂n/∂ξ = −T (TᵀT)⁻¹ B with B_αβ = n·s_αβ; then ∂x/∂ξ = T + g ∂n/∂ξ at fixed gap.
  Eigen::Matrix<double, 3, 2> T;
  T << j.s1, j.s2;
  Eigen::Matrix2d B;
  B << n.dot(j.s11), n.dot(j.s12), n.dot(j.s12), n.dot(j.s22);
  const Eigen::Matrix<double, 3, 2> dn = -T * (T.transpose() * T).inverse() * B;
  const Eigen::Matrix<double, 3, 2> dx = T + g * dn;
  return {g, n, dn * (dx.transpose() * dx).inverse() * dx.transpose()};
}

void WallHold::remember_rest(const SurfacePoint& point) {
  if (static_cast<int>(remembered_.size()) <= point.index) remembered_.resize(point.index + 1);
  remembered_[point.index] = gap_at_rest(point);
}

double WallHold::gap_at_rest(const SurfacePoint& point) const {
  if (rest_ == WallRest::on_wall) return 0;
  if (point.index < static_cast<int>(remembered_.size()) && remembered_[point.index])
    return *remembered_[point.index];
  return surface_->gap(point.X).gap;
}

bool WallHold::respond(const Eigen::Matrix<double, 9, 1>& y, const SurfacePoint& point, int order,
                       SurfaceResponse& response) const {
  const Gap gap = surface_->gap(y.head<3>());
  const double off = gap.gap - gap_at_rest(point);
  response.energy = penalty_ / 2 * off * off;
  response.gradient.head<3>() = penalty_ * off * gap.normal;
  if (order == 2)
    response.hessian.topLeftCorner<3, 3>() =
        penalty_ * (gap.normal * gap.normal.transpose() + off * gap.hessian);
  return true;
}

Eigen::Matrix<double, 9, 9> WallHold::reference_derivative(const Eigen::Matrix<double, 9, 1>& y,
                                                           const SurfacePoint& point) const {
  Eigen::Matrix<double, 9, 9> derivative = Eigen::Matrix<double, 9, 9>::Zero();
  if (rest_ == WallRest::as_reference)
    derivative.topLeftCorner<3, 3>() =
        -penalty_ * surface_->gap(y.head<3>()).normal * surface_->gap(point.X).normal.transpose();
  return derivative;
}

}  // namespace mammotwin
