#include "fitting/solve/shape_energy.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {

namespace {

/// Gauss-Lobatto points on [0,1]: the ends, the middle and (1 ± √(3/7)) / 2.
std::vector<double> lobatto_points() {
  const double s = std::sqrt(3.0 / 7) / 2;
  return {0, 0.5 - s, 0.5, 0.5 + s, 1};
}

/// What e counts, steep or not, with its derivatives by e.
struct Growth {
  double value, slope, curvature;

  Growth(double e, bool steep) : value(e), slope(1), curvature(0) {
    if (!steep) return;
    const double cube = std::pow(e / ShapeEnergy::bad, 3);
    value += e * cube, slope += 4 * cube, curvature = 12 * cube / e;
  }
};

/// 0 to 1, both of them.
std::vector<double> even_points(int count) {
  std::vector<double> points;
  for (int i = 0; i < count; ++i) points.push_back(i / (count - 1.0));
  return points;
}

/// Mean over elements of the length of the line ξ = const through the element's centre.
Eigen::Vector3d mean_lengths(const HermiteMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int e = 0; e < mesh.num_elements(); ++e)
    sum += mesh.jacobian({e, Eigen::Vector3d::Constant(0.5)}).colwise().norm().transpose();
  return sum / mesh.num_elements();
}

/// First derivatives of the basis at a grid of points, in units of `lengths`.
Eigen::MatrixXd gradient_matrix(const TensorHessian& grid, const Eigen::Vector3d& lengths) {
  const int points = grid.num_points();
  Eigen::MatrixXd matrix(3 * points, 64);
  for (int q = 0; q < points; ++q)
    for (int i = 0; i < 3; ++i) {
      std::array<int, 3> order = {0, 0, 0};
      order[i] = 1;
      matrix.row(i * points + q) = basis_row(grid.point(q), order) / lengths[i];
    }
  return matrix;
}

/// F at point q.
template <class Gradients>
Eigen::Matrix3d at(const Gradients& F, int q) {
  const auto points = F.cols() / 3;
  Eigen::Matrix3d at_q;
  at_q << F.col(q), F.col(points + q), F.col(2 * points + q);
  return at_q;
}

/// Typical length over the one that each element should have along each ξ.
std::vector<Eigen::Vector3d> stretches(const Slab& slab, const HermiteMesh& start,
                                       double mean_thickness) {
  // Thin sheets beside a breast keep their thickness, folded or empty starts do not count.
  constexpr double thickest = 0.4, thinnest = 4;
  const auto of_column = [&](int direction, int i) {
    const double n = slab.elements[direction];
    const Grading& g = slab.grading[direction];
    return 1 / (n * (g.place((i + 1) / n) - g.place(i / n)));
  };
  std::vector<Eigen::Vector3d> result;
  for (int e = 0; e < start.num_elements(); ++e) {
    const int i = e % slab.elements.x(), j = e / slab.elements.x() % slab.elements.y();
    const double thickness = start.jacobian({e, Eigen::Vector3d::Constant(0.5)}).col(2).norm();
    result.emplace_back(of_column(0, i), of_column(1, j),
                        std::clamp(mean_thickness / thickness, thickest, thinnest));
  }
  return result;
}

}  // namespace

ShapeEnergy::ShapeEnergy(const Slab& slab, const HermiteMesh& start)
    : emphasis_(start.num_elements(), 0),
      grids_{TensorHessian(lobatto_points(), mean_lengths(start)),
             TensorHessian(even_points(6), mean_lengths(start)),
             TensorHessian(even_points(9), mean_lengths(start))} {
  const Eigen::Vector3d lengths = mean_lengths(start);
  for (std::size_t g = 0; g < grids_.size(); ++g)
    gradients_[g] = gradient_matrix(grids_[g], lengths);
  stretch_ = stretches(slab, start, lengths.z());
}

ShapeEnergy::Gradients ShapeEnergy::gradients_of(const ElementShape& x, int element) const {
  Gradients F = x * gradients(element).transpose();
  const auto points = F.cols() / 3;
  for (int i = 0; i < 3; ++i) F.middleCols(i * points, points) *= stretch_[element][i];
  return F;
}

double ShapeEnergy::point_weight(int element) const {
  const double points = grid(element).num_points();
  return std::pow(4, emphasis_[element]) / (points * static_cast<double>(emphasis_.size()));
}

double ShapeEnergy::smallest_determinant(const ElementShape& x, int element) const {
  const Gradients F = gradients_of(x, element);
  double smallest = at(F, 0).determinant();
  for (int q = 1; q < F.cols() / 3; ++q) smallest = std::min(smallest, at(F, q).determinant());
  return smallest;
}

void ShapeEnergy::renew_epsilon(const std::vector<ElementShape>& elements) {
  std::vector<double> smallest(elements.size());
  tbb::parallel_for(0, static_cast<int>(elements.size()),
                    [&](int e) { smallest[e] = smallest_determinant(elements[e], e); });
  energy_ = FoldoverEnergy::for_smallest(*std::min_element(smallest.begin(), smallest.end()));
}

double ShapeEnergy::cost(const ElementShape& x, int element) const {
  const Gradients F = gradients_of(x, element);
  double sum = 0;
  for (int q = 0; q < F.cols() / 3; ++q) sum += Growth(energy_.value(at(F, q)), steep_).value;
  return point_weight(element) * sum;
}

void ShapeEnergy::add(const ElementShape& x, int element, double weight,
                      ElementQuadratic& to) const {
  const TensorHessian& grid = this->grid(element);
  const Gradients F = gradients_of(x, element);
  const Eigen::Vector3d& stretch = stretch_[element];
  const double scale = weight * point_weight(element);
  Gradients stress(3, F.cols());
  std::vector<double> tangents(grid.num_entries());
  for (int q = 0; q < grid.num_points(); ++q) {
    const Eigen::Matrix3d Fq = at(F, q);
    const Growth by_e(energy_.value(Fq), steep_);
    const FoldoverEnergy::Gradient e_by_F = energy_.gradient(Fq);
    const Eigen::Matrix3d stress_q =
        scale * by_e.slope * e_by_F.reshaped(3, 3) * stretch.asDiagonal();
    const FoldoverEnergy::Hessian tangent =
        scale * by_e.slope *
        (gauss_newton_ ? energy_.gauss_newton(Fq)
                       : energy_.convex_hessian(Fq, by_e.curvature / by_e.slope));
    for (int i = 0; i < 3; ++i) {
      stress.col(i * grid.num_points() + q) = stress_q.col(i);
      for (int j = 0; j < 3; ++j) {
        double* entries = &tangents[grid.place(i, j, q)];
        for (int c = 0; c < 3; ++c)
          for (int b = 0; b <= c; ++b)
            entries[TensorHessian::pair(c, b)] =
                stretch[i] * stretch[j] * tangent(c + 3 * i, b + 3 * j);
      }
    }
  }
  const ElementShape by_x = stress * gradients(element);
  to.gradient += by_x.reshaped();
  grid.add(tangents, to.hessian);
}

}  // namespace mammotwin
