#include "solver/element/face.h"

#include <Eigen/Geometry>
#include <cassert>

#include "fitting/mesh/hermite_basis.h"
#include "solver/element/gauss.h"

namespace mammotwin {

namespace {

constexpr int kStride[3] = {1, 4, 16};  // of the one-dimensional index along each ξ

std::array<int, Face::kFunctions> face_functions(int face) {
  const auto [d1, d2] = face_directions(face);
  const int fixed = 2 * (face % 2) * kStride[face / 2];
  std::array<int, Face::kFunctions> functions;
  for (int a = 0; a < Face::kFunctions; ++a)
    functions[a] = fixed + (a & 3) * kStride[d1] + (a >> 2) * kStride[d2];
  return functions;
}

/// +1 where a₁ x a₂ points out of the element.
double orientation(int face) {
  const double upper = face / 2 == 1 ? -1 : 1;  // ξ₁ x ξ₃ points against ξ₂
  return face % 2 ? upper : -upper;
}

}  // namespace

struct Face::Table {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, kFunctions, Eigen::RowMajor>;
  std::array<Values, 3> slots;  ///< value, and the derivatives along the face's two directions
  std::vector<double> weights;

  explicit Table(int n) {
    const auto [points, weights1d] = gauss_rule(n);
    for (auto& slot : slots) slot.resize(n * n, kFunctions);
    for (int q = 0; q < n * n; ++q) {
      const double s = points[q % n], r = points[q / n];
      const auto h1 = hermite_values(s), h2 = hermite_values(r);
      const auto s1 = hermite_first_derivatives(s), s2 = hermite_first_derivatives(r);
      for (int a = 0; a < kFunctions; ++a) {
        slots[0](q, a) = h1[a & 3] * h2[a >> 2];
        slots[1](q, a) = s1[a & 3] * h2[a >> 2];
        slots[2](q, a) = h1[a & 3] * s2[a >> 2];
      }
      weights.push_back(weights1d[q % n] * weights1d[q / n]);
    }
  }
};

const Face::Table& Face::table(int points1d) {
  constexpr int most = 16;
  static const std::vector<Table> tables = [] {
    std::vector<Table> all;
    for (int n = 1; n <= most; ++n) all.emplace_back(n);
    return all;
  }();
  assert(points1d >= 4 && points1d <= most);
  return tables[points1d - 1];
}

Face::Face(int element, int face, const SolidElement::Coefficients& X, int points1d,
           int first_index)
    : element_(element),
      face_(face),
      points1d_(points1d),
      functions_(face_functions(face)),
      points_(points1d * points1d) {
  for (int q = 0; q < num_points(); ++q) {
    const auto Y = deformed(X, q);
    const Eigen::Vector3d A1 = Y.segment<3>(3), A2 = Y.segment<3>(6);
    const Eigen::Vector3d area_vector = orientation(face) * A1.cross(A2);
    const double weight = table(points1d).weights[q];
    points_[q] = {Y.head<3>(),    A1, A2, area_vector.normalized(), weight * area_vector.norm(),
                  first_index + q};
  }
}

double Face::area() const {
  double area = 0;
  for (const auto& point : points_) area += point.area;
  return area;
}

Eigen::Matrix<double, 9, 1> Face::deformed(const SolidElement::Coefficients& x, int q) const {
  const auto& N = table(points1d_).slots;
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  for (int slot = 0; slot < 3; ++slot)
    for (int a = 0; a < kFunctions; ++a)
      y.segment<3>(3 * slot) += N[slot](q, a) * x.row(functions_[a]).transpose();
  return y;
}

namespace {

void take_convex_part(SurfacePotential::Slots slots, Eigen::Matrix<double, 9, 9>& hessian) {
  const auto [first, end] = slots;
  if (first == 0 && end == 1)
    hessian.topLeftCorner<3, 3>() = convex_part<3>(hessian.topLeftCorner<3, 3>());
  else if (first == 1)
    hessian.bottomRightCorner<6, 6>() = convex_part<6>(hessian.bottomRightCorner<6, 6>());
  else
    hessian = convex_part<9>(hessian);
}

}  // namespace

void Face::add(const SurfacePotential& potential, const SolidElement::Coefficients& x,
               TangentKind kind, ElementSystem& system) const {
  const bool with_tangent = kind != TangentKind::none;
  const auto [first, end] = potential.slots();
  const auto& N = table(points1d_).slots;
  Eigen::Matrix<double, kFunctions, 3> c;
  for (int a = 0; a < kFunctions; ++a) c.row(a) = x.row(functions_[a]);
  Eigen::Matrix<double, 9, 1> y = Eigen::Matrix<double, 9, 1>::Zero();
  SurfaceResponse response;
  Eigen::Matrix<double, kFunctions, 3> residual;
  Eigen::Matrix<double, 3 * kFunctions, 3 * kFunctions> tangent;
  bool touched = false;
  for (int q = 0; q < num_points(); ++q) {
    for (int s = first; s < end; ++s) y.segment<3>(3 * s) = c.transpose() * N[s].row(q).transpose();
    if (!potential.respond(y, points_[q], with_tangent ? 2 : 1, response)) continue;
    if (!touched) {
      residual.setZero();
      if (with_tangent) tangent.setZero();
    }
    if (kind == TangentKind::convex) take_convex_part(potential.slots(), response.hessian);
    touched = true;
    const double area = points_[q].area;
    system.energy += area * response.energy;
    for (int s = first; s < end; ++s) {
      const auto Ns = (area * N[s].row(q)).eval();
      residual += Ns.transpose() * response.gradient.segment<3>(3 * s).transpose();
      if (!with_tangent) continue;
      for (int r = first; r < end; ++r) {
        const Eigen::Matrix<double, kFunctions, kFunctions> NN = Ns.transpose() * N[r].row(q);
        for (int k = 0; k < 3; ++k)
          for (int i = k; i < 3; ++i)
            tangent.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * k) +=
                response.hessian(3 * s + i, 3 * r + k) * NN;
      }
    }
  }
  if (!touched) return;
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < kFunctions; ++a)
      system.residual[mammotwin::kFunctions * i + functions_[a]] += residual(a, i);
  if (!with_tangent) return;
  for (int k = 0; k < 3; ++k)
    for (int i = k; i < 3; ++i)
      for (int b = 0; b < kFunctions; ++b)
        for (int a = i == k ? b : 0; a < kFunctions; ++a)
          system.tangent(mammotwin::kFunctions * i + functions_[a],
                         mammotwin::kFunctions * k + functions_[b]) +=
              tangent(kFunctions * i + a, kFunctions * k + b);
}

bool Face::add_circulation(const SurfacePotential& potential, const SolidElement::Coefficients& x,
                           Circulation& circulation) const {
  const auto& N = table(points1d_).slots[0];
  Eigen::Matrix3d derivative;
  bool any = false;
  for (int q = 0; q < num_points(); ++q) {
    if (!potential.circulation(deformed(x, q), points_[q], derivative)) continue;
    any = true;
    const Eigen::Matrix<double, kFunctions, kFunctions> NN =
        points_[q].area * N.row(q).transpose() * N.row(q);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        circulation.block<kFunctions, kFunctions>(kFunctions * i, kFunctions * k) +=
            derivative(i, k) * NN;
  }
  return any;
}

/// The residual is area(A₁, A₂) times gradient(y; X, A₁, A₂): both factors change.
void Face::add_reference(const SurfacePotential& potential, const SolidElement::Coefficients& x,
                         ReferenceSystem& system) const {
  const auto [first, end] = potential.slots();
  const auto& N = table(points1d_).slots;
  SurfaceResponse response;
  response.gradient.setZero();
  for (int q = 0; q < num_points(); ++q) {
    const SurfacePoint& point = points_[q];
    const auto y = deformed(x, q);
    if (!potential.respond(y, point, 1, response)) continue;
    const Eigen::Vector3d area_vector = point.A1.cross(point.A2);
    const Eigen::Vector3d n = area_vector.normalized();
    Eigen::Matrix<double, 9, 1> area_change;  // ∂ ln area/∂(X, A₁, A₂)
    area_change << Eigen::Vector3d::Zero(), point.A2.cross(n), n.cross(point.A1);
    area_change /= area_vector.norm();
    const Eigen::Matrix<double, 9, 9> change =
        point.area *
        (potential.reference_derivative(y, point) + response.gradient * area_change.transpose());
    for (int s = first; s < end; ++s)
      for (int r = 0; r < 3; ++r) {
        const Eigen::Matrix<double, kFunctions, kFunctions> NN =
            N[s].row(q).transpose() * N[r].row(q);
        for (int b = 0; b < kFunctions; ++b)
          for (int a = 0; a < kFunctions; ++a)
            for (int k = 0; k < 3; ++k)
              for (int i = 0; i < 3; ++i)
                system.tangent(mammotwin::kFunctions * i + functions_[a],
                               mammotwin::kFunctions * k + functions_[b]) +=
                    change(3 * s + i, 3 * r + k) * NN(a, b);
      }
  }
}

}  // namespace mammotwin
