#include "fitting/solve/fit_model.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mammotwin {

namespace {

/// Gauss-Lobatto points on [0,1]: the ends, the middle and (1 ± √(3/7)) / 2.
std::vector<double> lobatto_points() {
  const double s = std::sqrt(3.0 / 7) / 2;
  return {0, 0.5 - s, 0.5, 0.5 + s, 1};
}

std::vector<double> even_points() { return {0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1}; }

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
    : elements_(start.elements()),
      mu_(mu),
      sobolev_(sobolev),
      centre_(Eigen::Vector3d::Zero()),
      emphasis_(std::move(emphasis)),
      grids_{TensorHessian(lobatto_points(), mean_lengths(start)),
             TensorHessian(even_points(), mean_lengths(start))},
      smoothing_(smoothing_matrix(slab.elements)) {
  for (int n = 0; n < start.num_nodes(); ++n) centre_ += start.node(n).col(0) / start.num_nodes();
  const Eigen::Vector3d lengths = mean_lengths(start);
  for (int emphasised : {0, 1})
    gradients_[emphasised] = gradient_matrix(grids_[emphasised], lengths);
  stretch_ = stretches(slab, start, lengths.z());
}

FitModel::Gradients FitModel::gradients_of(const Shape& x, int element) const {
  Gradients F = x * gradients(element).transpose();
  const auto points = F.cols() / 3;
  for (int i = 0; i < 3; ++i) F.middleCols(i * points, points) *= stretch_[element][i];
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
    smallest[e] = at(F, 0).determinant();
    for (int q = 1; q < F.cols() / 3; ++q)
      smallest[e] = std::min(smallest[e], at(F, q).determinant());
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
  tbb::parallel_for(0, static_cast<int>(elements_.size()),
                    [&](int e) { linear_[e] = linear(samples, of_element[e], centre_); });
}

FitModel::Linear FitModel::linear(const std::vector<PlaneSample>& samples,
                                  const std::vector<int>& of_element,
                                  const Eigen::Vector3d& centre) {
  Eigen::MatrixXd basis(of_element.size(), 64);
  for (std::size_t i = 0; i < of_element.size(); ++i)
    basis.row(i) = basis_row(samples[of_element[i]].point.xi, {0, 0, 0});
  std::vector<int> seen;
  for (int p = 0; p < 64; ++p)
    if (!basis.col(p).isZero(0)) seen.push_back(p);

  Linear l;
  for (int p : seen) l.parameters.insert(l.parameters.end(), {3 * p, 3 * p + 1, 3 * p + 2});
  l.a.setZero(l.parameters.size(), l.parameters.size());
  l.b.setZero(l.parameters.size());
  Eigen::VectorXd row(l.parameters.size());
  for (std::size_t i = 0; i < of_element.size(); ++i) {
    const PlaneSample& sample = samples[of_element[i]];
    for (std::size_t p = 0; p < seen.size(); ++p)
      row.segment<3>(3 * p) = basis(i, seen[p]) * sample.normal;
    const double goal = sample.normal.dot(sample.target - centre);
    l.a.selfadjointView<Eigen::Lower>().rankUpdate(row, sample.weight);
    l.b += sample.weight * goal * row;
    l.c += sample.weight * goal * goal / 2;
  }
  l.a.triangularView<Eigen::StrictlyUpper>() = l.a.transpose();
  return l;
}

double FitModel::Linear::cost(const ElementVector& x) const {
  const Eigen::VectorXd seen = x(parameters);
  return 0.5 * seen.dot(a * seen) - b.dot(seen) + c;
}

double FitModel::cost(const std::vector<HermiteMesh::Node>& nodes, int e) const {
  const Shape x = shape(nodes, e);
  const Eigen::Map<const ElementVector> flat(x.data());
  double cost = linear_[e].cost(flat);
  cost += 0.5 * sobolev_ * (x * smoothing_).cwiseProduct(x).sum();
  const Gradients F = gradients_of(x, e);
  double energy = 0;
  for (int q = 0; q < F.cols() / 3; ++q) energy += energy_.value(at(F, q));
  return cost + energy_weight(e) * energy;
}

FitModel::Quadratic FitModel::quadratic(const std::vector<HermiteMesh::Node>& nodes, int e) const {
  const Shape x = shape(nodes, e);
  const Eigen::Map<const ElementVector> flat(x.data());
  Quadratic result;
  result.cost = cost(nodes, e);
  add_energy(x, e, result);
  const Shape smooth = sobolev_ * x * smoothing_;
  result.gradient += Eigen::Map<const ElementVector>(smooth.data());
  for (int c = 0; c < 3; ++c)
    result.hessian(Eigen::seqN(c, 64, 3), Eigen::seqN(c, 64, 3)) += sobolev_ * smoothing_;
  const Linear& l = linear_[e];
  result.gradient(l.parameters) += l.a * flat(l.parameters) - l.b;
  result.hessian(l.parameters, l.parameters) += l.a;
  return result;
}

void FitModel::add_energy(const Shape& x, int e, Quadratic& to) const {
  const TensorHessian& grid = this->grid(e);
  const Gradients F = gradients_of(x, e);
  const Eigen::Vector3d& stretch = stretch_[e];
  const double scale = energy_weight(e);
  Gradients stress(3, F.cols());
  std::vector<double> tangents(grid.num_entries());
  for (int q = 0; q < grid.num_points(); ++q) {
    const Eigen::Matrix3d Fq = at(F, q);
    const Eigen::Matrix3d stress_q =
        scale * energy_.gradient(Fq).reshaped(3, 3) * stretch.asDiagonal();
    const FoldoverEnergy::Hessian tangent = scale * energy_.positive_hessian(Fq);
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
  const Shape by_x = stress * gradients(e);
  to.gradient += Eigen::Map<const ElementVector>(by_x.data());
  grid.add(tangents, to.hessian);
}

}  // namespace mammotwin
