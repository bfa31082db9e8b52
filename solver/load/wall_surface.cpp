#include "solver/load/wall_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/face.h"

namespace mammotwin {

namespace {

constexpr int kProjectionSteps = 30;  // Newton converges in 3 to 6
constexpr int kHalvings = 8;  // of a step that leads away from the point: Newton alone can cycle
constexpr double kRounding = 1e-12;  // [mm] of a distance
constexpr double kBeyondRim = 60;    // [mm] that it goes on by, about: breasts slide by centimetres
constexpr double kRimTolerance = 1e-9;
constexpr double kLastStep = 1e-11;  // of a patch's side: the next is rounding

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

Eigen::Vector3d position(const Eigen::Matrix<double, 3, 16>& c, const Eigen::Vector2d& xi) {
  return combine(c, extended(xi[0], 0), extended(xi[1], 0));
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

namespace {

using Coefficients = Eigen::Matrix<double, 3, 16>;

/// The patch that goes straight on from a patch's end (0 or 1) of direction d, `ahead` times as far
/// as it is wide.
Coefficients straight_on(const Coefficients& c, int d, int end, double ahead) {
  Coefficients next;
  for (int b = 0; b < 4; ++b) {
    const auto at = [&](int a) { return d == 0 ? a + 4 * b : b + 4 * a; };
    const Eigen::Vector3d value = c.col(at(2 * end)), way = ahead * c.col(at(2 * end + 1));
    next.col(at(0)) = end == 1 ? value : (value - way).eval();
    next.col(at(2)) = end == 1 ? (value + way).eval() : value;
    next.col(at(1)) = next.col(at(3)) = way;
  }
  return next;
}

double mean_side(const std::vector<Coefficients>& patches) {
  double sum = 0;
  for (const Coefficients& c : patches)
    sum += (c.col(2) - c.col(0)).norm() + (c.col(8) - c.col(0)).norm();
  return sum / (2 * patches.size());
}

/// Sides that only one face has: of each face, by direction and end.
std::vector<std::array<std::array<bool, 2>, 2>> sides_at_rim(
    const HermiteMesh& mesh, const std::vector<std::pair<int, int>>& faces) {
  const auto side = [&](const std::pair<int, int>& of, int d, int end) {
    const int first = d == 0 ? 2 * end : 8 * end, second = first + (d == 0 ? 8 : 2);
    return std::minmax({face_parameter(mesh, of.first, of.second, first).first,
                        face_parameter(mesh, of.first, of.second, second).first});
  };
  std::map<std::pair<int, int>, int> shared;
  for (const auto& face : faces)
    for (int d = 0; d < 2; ++d)
      for (int end = 0; end < 2; ++end) ++shared[side(face, d, end)];
  std::vector<std::array<std::array<bool, 2>, 2>> at_rim(faces.size());
  for (std::size_t n = 0; n < faces.size(); ++n)
    for (int d = 0; d < 2; ++d)
      for (int end = 0; end < 2; ++end) at_rim[n][d][end] = shared[side(faces[n], d, end)] == 1;
  return at_rim;
}

}  // namespace

WallSurface::WallSurface(const HermiteMesh& mesh, const std::vector<std::pair<int, int>>& faces) {
  if (faces.empty()) throw std::invalid_argument("the chest wall has no faces");
  std::vector<Coefficients> patches;
  for (const auto& [element, face] : faces)
    patches.push_back(face_coefficients(mesh, element, face));
  const double ahead = kBeyondRim / mean_side(patches);
  const auto at_rim = sides_at_rim(mesh, faces);
  for (std::size_t n = 0; n < faces.size(); ++n) {
    const int face = faces[n].second;
    const double outward = (face / 2 == 1 ? -1 : 1) * (face % 2 ? 1 : -1);
    add_patch(patches[n], -outward);
    for (int end = 0; end < 2; ++end) {
      if (at_rim[n][1][end]) add_patch(straight_on(patches[n], 1, end, ahead), -outward);
      if (!at_rim[n][0][end]) continue;
      const Coefficients beside = straight_on(patches[n], 0, end, ahead);
      add_patch(beside, -outward);
      for (int other = 0; other < 2; ++other)
        if (at_rim[n][1][other]) add_patch(straight_on(beside, 1, other, ahead), -outward);
    }
  }
  find_boxes();
}

void WallSurface::add_patch(const Coefficients& coefficients, double orientation) {
  Patch patch;
  patch.coefficients = coefficients;
  for (int k = 0; k < kSamples1d * kSamples1d; ++k) {
    const Eigen::Vector2d xi(k % kSamples1d, k / kSamples1d);
    patch.samples.col(k) = position(coefficients, xi / (kSamples1d - 1.0));
  }
  patch.orientation = orientation;
  patches_.push_back(patch);
}

void WallSurface::find_boxes() {
  const auto count = static_cast<Eigen::Index>(patches_.size());
  low_.resize(count, 3);
  high_.resize(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    const Eigen::AlignedBox3d box = bezier_box(patches_[n].coefficients);
    low_.row(n) = box.min().transpose();
    high_.row(n) = box.max().transpose();
  }
}

WallSurface::Foot WallSurface::project_from(const Patch& patch, Eigen::Vector2d xi,
                                            const Eigen::Vector3d& x) const {
  SurfaceJet here = jet(patch.coefficients, xi);
  for (int step = 0; step < kProjectionSteps; ++step) {
    Eigen::Vector2d delta = foot_step(here, x);
    const bool last = delta.cwiseAbs().maxCoeff() < kLastStep;
    const double farthest = (x - here.s).norm() + kRounding;
    SurfaceJet there = jet(patch.coefficients, xi + delta);
    for (int halving = 0; halving < kHalvings && (x - there.s).norm() > farthest; ++halving) {
      delta /= 2;
      there = jet(patch.coefficients, xi + delta);
    }
    xi += delta;
    here = there;
    if (last) break;
  }
  const Eigen::Vector2d clamped = xi.cwiseMax(0).cwiseMin(1);
  return {&patch, xi, (x - position(patch.coefficients, clamped)).norm(),
          (xi - clamped).cwiseAbs().maxCoeff() <= kRimTolerance};
}

namespace {

/// The least of each entry and its up to eight neighbours.
template <class Grid>
Grid least_around(const Grid& grid) {
  constexpr int n = Grid::RowsAtCompileTime, all_but_one = n - 1;
  Grid in_column = grid;
  in_column.template topRows<all_but_one>() =
      grid.template topRows<all_but_one>().min(grid.template bottomRows<all_but_one>());
  in_column.template bottomRows<all_but_one>() =
      in_column.template bottomRows<all_but_one>().min(grid.template topRows<all_but_one>());
  Grid least = in_column;
  least.template leftCols<all_but_one>() =
      in_column.template leftCols<all_but_one>().min(in_column.template rightCols<all_but_one>());
  least.template rightCols<all_but_one>() =
      least.template rightCols<all_but_one>().min(in_column.template leftCols<all_but_one>());
  return least;
}

}  // namespace

/// From every sample that is nearer than its neighbours.
WallSurface::Foot WallSurface::project(const Patch& patch, const Eigen::Vector3d& x) const {
  Eigen::Array<double, kSamples1d, kSamples1d> distance;  // squared
  distance.reshaped() = (patch.samples.colwise() - x).colwise().squaredNorm().transpose();
  const auto least = least_around(distance);
  Foot best{nullptr, {}, 0, false};
  for (int j = 0; j < kSamples1d; ++j)
    for (int i = 0; i < kSamples1d; ++i) {
      if (distance(i, j) > least(i, j)) continue;
      const Foot foot = project_from(patch, Eigen::Vector2d(i, j) / (kSamples1d - 1.0), x);
      if (!best.patch || foot.distance < best.distance) best = foot;
    }
  return best;
}

/// Patches are asked in the order of their boxes' distance, until no box is nearer than a foot.
WallSurface::Foot WallSurface::nearest_foot(const Eigen::Vector3d& x) const {
  static thread_local Eigen::ArrayXd away;  // squared, of each box
  away.setZero(low_.rows());
  for (int i = 0; i < 3; ++i)
    away += (low_.col(i) - x[i]).max(x[i] - high_.col(i)).max(0.0).square();
  Foot best{nullptr, {}, 0, false};
  for (std::size_t asked = 0; asked < patches_.size(); ++asked) {
    Eigen::Index next;
    const double at_least = std::sqrt(away.minCoeff(&next));
    if (best.patch && at_least > best.distance + kRimTolerance) break;
    away[next] = std::numeric_limits<double>::infinity();
    const Foot foot = project(patches_[next], x);
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
