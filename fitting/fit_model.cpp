#include "fitting/fit_model.h"

#include <Eigen/LU>

#include <cblas.h>

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

std::vector<double> even_points() {
  return {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1};
}

Eigen::Matrix<double, 1, 64> basis_row(const Eigen::Vector3d& xi, const std::array<int, 3>& order) {
  const HermiteMesh::Weights w = HermiteMesh::weights(xi, order);
  Eigen::Matrix<double, 1, 64> row;
  for (int n = 0; n < 8; ++n) row.segment<8>(8 * n) = w.row(n);
  return row;
}

/// Mean over elements of the length of the line ξ = const through the element's centre.
Eigen::Vector3d mean_lengths(const HermiteMesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int e = 0; e < mesh.num_elements(); ++e)
    sum += mesh.jacobian({e, Eigen::Vector3d::Constant(0.5)}).colwise().norm().transpose();
  return sum / mesh.num_elements();
}

/// First derivatives of the basis at a grid of points, in units of `lengths`.
Eigen::MatrixXd gradient_matrix(const std::vector<double>& x, const Eigen::Vector3d& lengths) {
  const int n = static_cast<int>(x.size());
  Eigen::MatrixXd matrix(3 * n * n * n, 64);
  for (int q = 0; q < n * n * n; ++q)
    for (int i = 0; i < 3; ++i) {
      std::array<int, 3> order = {0, 0, 0};
      order[i] = 1;
      matrix.row(3 * q + i) = basis_row({x[q % n], x[q / n % n], x[q / n / n]}, order) / lengths[i];
    }
  return matrix;
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

/// ∫ Σᵢⱼ (∂²/∂uᵢ∂uⱼ)² of the basis over one of n₁ n₂ n₃ equal elements.
Eigen::Matrix<double, 64, 64> smoothing_matrix(const Eigen::Vector3i& n) {
  // Gauss-Legendre with 4 points is exact for the squares of cubics' derivatives.
  constexpr std::array<double, 4> x = {0.06943184420297371, 0.33000947820757187,
                                       0.66999052179242813, 0.93056815579702629};
  constexpr std::array<double, 4> w = {0.17392742256872693, 0.32607257743127307,
                                       0.32607257743127307, 0.17392742256872693};
  Eigen::Matrix<double, 64, 64> m = Eigen::Matrix<double, 64, 64>::Zero();
  for (int q = 0; q < 64; ++q)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        std::array<int, 3> order = {0, 0, 0};
        ++order[i];
        ++order[j];
        const auto row = basis_row({x[q % 4], x[q / 4 % 4], x[q / 16]}, order);
        const double scale = n[i] * n[j];
        m += w[q % 4] * w[q / 4 % 4] * w[q / 16] * scale * scale * row.transpose() * row;
      }
  return m / n.prod();
}

}  // namespace

FitModel::FitModel(const Slab& slab, const HermiteMesh& start, double mu, double sobolev,
                   std::vector<int> emphasis)
    : elements_(start.elements()), mu_(mu), sobolev_(sobolev), centre_(Eigen::Vector3d::Zero()),
      emphasis_(std::move(emphasis)), smoothing_(smoothing_matrix(slab.elements)) {
  for (int n = 0; n < start.num_nodes(); ++n) centre_ += start.node(n).col(0) / start.num_nodes();
  const Eigen::Vector3d lengths = mean_lengths(start);
  gradients_ = {gradient_matrix(lobatto_points(), lengths), gradient_matrix(even_points(), lengths)};
  stretch_ = stretches(slab, start, lengths.z());
}

FitModel::Gradients FitModel::gradients_of(const Shape& x, int element) const {
  Gradients F = x * gradients(element).transpose();
  for (int column = 0; column < F.cols(); ++column) F.col(column) *= stretch_[element][column % 3];
  return F;
}

double FitModel::energy_weight(int element) const {
  const double points = gradients(element).rows() / 3;
  return mu_ * std::pow(4, emphasis_[element]) / (points * elements_.size());
}

FitModel::Shape FitModel::shape(const std::vector<HermiteMesh::Node>& nodes, int element) const {
  Shape x;
  for (int n = 0; n < 8; ++n) {
    x.middleCols<8>(8 * n) = nodes[elements_[element][n]];
    x.col(8 * n) -= centre_;
  }
  return x;
}

double FitModel::smallest_determinant(const std::vector<HermiteMesh::Node>& nodes) const {
  std::vector<double> smallest(elements_.size());
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    const Gradients F = gradients_of(shape(nodes, e), e);
    smallest[e] = F.leftCols<3>().determinant();
    for (int q = 1; q < F.cols() / 3; ++q)
      smallest[e] = std::min(smallest[e], F.middleCols<3>(3 * q).determinant());
  });
  return *std::min_element(smallest.begin(), smallest.end());
}

void FitModel::update(const std::vector<HermiteMesh::Node>& nodes,
                      const std::vector<PlaneSample>& samples) {
  energy_ = FoldoverEnergy::for_smallest(smallest_determinant(nodes));
  std::vector<std::vector<int>> of_element(elements_.size());
  for (std::size_t s = 0; s < samples.size(); ++s)
    of_element[samples[s].point.element].push_back(static_cast<int>(s));
  linear_.resize(elements_.size());
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    Linear& l = linear_[e];
    l.a = ElementMatrix::Zero(element_size, element_size);
    l.b.setZero();
    l.c = 0;
    for (int s : of_element[e]) {
      const PlaneSample& sample = samples[s];
      const auto basis = basis_row(sample.point.xi, {0, 0, 0});
      std::array<int, 64> used;
      int count = 0;
      for (int a = 0; a < 64; ++a)
        if (basis[a] != 0) used[count++] = a;
      const double goal = sample.normal.dot(sample.target - centre_);
      l.c += sample.weight * goal * goal / 2;
      for (int p = 0; p < count; ++p) {
        const Eigen::Vector3d row = sample.weight * basis[used[p]] * sample.normal;
        l.b.segment<3>(3 * used[p]) += goal * row;
        for (int q = 0; q <= p; ++q)
          l.a.block<3, 3>(3 * used[p], 3 * used[q]) +=
              basis[used[q]] * row * sample.normal.transpose();
      }
    }
    l.a = ElementMatrix(l.a.selfadjointView<Eigen::Lower>());
  });
}

double FitModel::cost(const std::vector<HermiteMesh::Node>& nodes, int e) const {
  const Shape x = shape(nodes, e);
  const Eigen::Map<const ElementVector> flat(x.data());
  const Linear& l = linear_[e];
  double cost = 0.5 * flat.dot(l.a * flat) - l.b.dot(flat) + l.c;
  cost += 0.5 * sobolev_ * (x * smoothing_).cwiseProduct(x).sum();
  const Gradients F = gradients_of(x, e);
  double energy = 0;
  for (int q = 0; q < F.cols() / 3; ++q) energy += energy_.value(F.middleCols<3>(3 * q));
  return cost + energy_weight(e) * energy;
}

FitModel::Quadratic FitModel::quadratic(const std::vector<HermiteMesh::Node>& nodes, int e) const {
  const Shape x = shape(nodes, e);
  const Eigen::Map<const ElementVector> flat(x.data());
  const Linear& l = linear_[e];
  Quadratic result;
  result.cost = cost(nodes, e);
  result.gradient = l.a * flat - l.b;
  result.hessian = l.a;

  const Eigen::MatrixXd& gradients = this->gradients(e);
  const int num_points = static_cast<int>(gradients.rows() / 3);
  const double scale = energy_weight(e);
  const Gradients F = gradients_of(x, e);
  const Eigen::Vector3d& stretch = stretch_[e];
  Gradients stress(3, 3 * num_points);
  std::vector<FoldoverEnergy::Hessian> tangent(num_points);
  for (int q = 0; q < num_points; ++q) {
    const Eigen::Matrix3d Fq = F.middleCols<3>(3 * q);
    stress.middleCols<3>(3 * q) =
        scale * energy_.gradient(Fq).reshaped(3, 3) * stretch.asDiagonal();
    tangent[q] = scale * energy_.positive_hessian(Fq);
  }
  const Shape by_x = stress * gradients + sobolev_ * x * smoothing_;
  result.gradient += Eigen::Map<const ElementVector>(by_x.data());

  Eigen::MatrixXd product(3 * num_points, 64), block(64, 64);
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b <= c; ++b) {
      for (int q = 0; q < num_points; ++q) {
        Eigen::Matrix3d part;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            part(i, j) = stretch[i] * stretch[j] * tangent[q](c + 3 * i, b + 3 * j);
        product.middleRows<3>(3 * q).noalias() = part * gradients.middleRows<3>(3 * q);
      }
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, 64, 64, 3 * num_points, 1,
                  gradients.data(), 3 * num_points, product.data(), 3 * num_points, 0,
                  block.data(), 64);
      if (b == c) block += sobolev_ * smoothing_;
      for (int p = 0; p < 64; ++p)
        for (int r = 0; r < 64; ++r) {
          result.hessian(3 * p + c, 3 * r + b) += block(p, r);
          if (b != c) result.hessian(3 * r + b, 3 * p + c) += block(p, r);
        }
    }
  return result;
}

}  // namespace mammotwin
