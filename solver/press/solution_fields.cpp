#include "solver/press/solution_fields.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fitting/mesh/bezier.h"
#include "solver/element/gauss.h"

namespace mammotwin {

namespace {

using Bernstein = std::array<double, 4>;

Bernstein bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

/// Weighted means about the control points of a mesh.
class Means {
 public:
  Means(const BezierMesh& bezier, int components)
      : bezier_(bezier),
        sums_(Eigen::MatrixXd::Zero(components, bezier.points.size())),
        weights_(Eigen::VectorXd::Zero(bezier.points.size())) {}

  void add(int element, const Eigen::Vector3d& xi, double weight, const Eigen::VectorXd& value) {
    const Bernstein a = bernstein(xi.x()), b = bernstein(xi.y()), c = bernstein(xi.z());
    for (int m = 0; m < kFunctions; ++m) {
      const double w = weight * a[m % 4] * b[m / 4 % 4] * c[m / 16];
      if (w == 0) continue;
      const int point = bezier_.elements[element][m];
      sums_.col(point) += w * value;
      weights_[point] += w;
    }
  }

  bool known(int point) const { return weights_[point] > 0; }
  double mean(int row, int point) const {
    return known(point) ? sums_(row, point) / weights_[point] : 0;
  }
  PointField field(int first_row, int components) const {
    PointField field{components, {}};
    for (int point = 0; point < weights_.size(); ++point)
      for (int i = 0; i < components; ++i) field.values.push_back(mean(first_row + i, point));
    return field;
  }

 private:
  const BezierMesh& bezier_;
  Eigen::MatrixXd sums_;
  Eigen::VectorXd weights_;
};

/// Rows of the means over the volume.
enum VolumeRow {
  kStretches = 0,
  kStrain = 3,
  kStress = 9,
  kVonMises = 15,
  kMeanPressure,
  kGap,
  kVolumeRows
};

Eigen::Matrix<double, 6, 1> symmetric_parts(const Eigen::Matrix3d& A) {
  return (Eigen::Matrix<double, 6, 1>() << A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(1, 2), A(0, 2))
      .finished();
}

double von_mises(const Eigen::Matrix3d& sigma) {
  const Eigen::Matrix3d deviator = sigma - sigma.trace() / 3 * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

double nearest_gap(const Press& press, const Eigen::Vector3d& x) {
  return std::min(press.placed().support.gap(x).gap, press.placed().paddle.gap(x).gap);
}

/// F, total pressure (p and the grad-div part) and tissue at one point.
Eigen::VectorXd tissue_values(const Eigen::Matrix3d& F, double pressure, const Material& tissue) {
  const double J = F.determinant();
  const Eigen::Matrix3d C = F.transpose() * F;
  const Eigen::Matrix3d P = tissue.stress(F) + pressure * J * F.inverse().transpose();
  const Eigen::Matrix3d S = F.inverse() * P;
  const Eigen::Matrix3d sigma = P * F.transpose() / J;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squares(C, Eigen::EigenvaluesOnly);
  Eigen::VectorXd values(int{kVolumeRows});
  values.segment<3>(kStretches) = squares.eigenvalues().reverse().cwiseSqrt();
  values.segment<6>(kStrain) = symmetric_parts((C - Eigen::Matrix3d::Identity()) / 2);
  values.segment<6>(kStress) = symmetric_parts(S);
  values[kVonMises] = von_mises(sigma);
  values[kMeanPressure] = -sigma.trace() / 3;
  return values;
}

Means volume_means(const Press& press, const State& state, const BezierMesh& bezier) {
  const Model& model = press.model();
  const HermiteMesh deformed(state.x, model.reference().elements());
  const auto& t = hermite_table().points;
  Means means(bezier, kVolumeRows);
  for (int e = 0; e < model.num_elements(); ++e) {
    const SolidElement& element = model.element(e);
    const auto x = model.coefficients(state.x, e);
    const auto F = element.deformation_gradients(x);
    const auto p = element.pressures(x, &state.pressure[8 * e]);
    for (int q = 0; q < kPoints; ++q) {
      const Eigen::Vector3d xi(t[q & 3], t[q >> 2 & 3], t[q >> 4]);
      Eigen::VectorXd values = tissue_values(F[q], p[q], element.material(q));
      values[kGap] = nearest_gap(press, deformed.position({e, xi}));
      means.add(e, xi, element.point_weight(q), values);
    }
  }
  return means;
}

/// Gap and contact pressure on the faces that may meet a plate.
Means contact_means(const Press& press, const State& state, const BezierMesh& bezier) {
  const PlateContact& contact = *press.breast().contact;
  const auto points = gauss_rule(contact.points1d).points;
  Means means(bezier, 2);
  for (const auto& [e, number] : press.breast().contact_faces) {
    const auto x = press.model().coefficients(state.x, e);
    for (const Face& face : press.model().faces(e)) {
      if (face.face() != number || face.points1d() != contact.points1d) continue;
      for (int q = 0; q < face.num_points(); ++q) {
        const Eigen::Vector3d at = face.deformed(x, q).head<3>();
        double pressure = 0;
        for (std::size_t p = 0; p < contact.plates.size(); ++p)
          pressure += contact.pressure(contact.plates[p].gap(at).gap);
        means.add(e,
                  point_on_face(number, points[q % contact.points1d], points[q / contact.points1d]),
                  face.point(q).area, Eigen::Vector2d(nearest_gap(press, at), pressure));
      }
    }
  }
  return means;
}

/// On the faces that meet plates their own, inside the tissue's.
PointField gap_field(const Means& volume, const Means& surface) {
  PointField gap = volume.field(kGap, 1);
  for (std::size_t point = 0; point < gap.values.size(); ++point)
    if (surface.known(point)) gap.values[point] = surface.mean(0, point);
  return gap;
}

}  // namespace

std::map<std::string, PointField> solution_fields(const Press& press, const State& state) {
  const BezierMesh bezier(press.model().reference());
  const Means volume = volume_means(press, state, bezier);
  const Means surface = contact_means(press, state, bezier);
  return {{"principal_stretches", volume.field(kStretches, 3)},
          {"green_strain", volume.field(kStrain, 6)},
          {"second_piola_kirchhoff_kPa", volume.field(kStress, 6)},
          {"von_mises_kPa", volume.field(kVonMises, 1)},
          {"mean_pressure_kPa", volume.field(kMeanPressure, 1)},
          {"contact_gap_mm", gap_field(volume, surface)},
          {"contact_pressure_kPa", surface.field(1, 1)}};
}

}  // namespace mammotwin
