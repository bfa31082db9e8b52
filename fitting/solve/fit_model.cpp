#include "fitting/solve/fit_model.h"

#include <tbb/parallel_for.h>

namespace mammotwin {

namespace {

// Gauss-Legendre with 4 points is exact for the squares of cubics.
constexpr std::array<double, 4> x = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                     0.93056815579702629};
constexpr std::array<double, 4> w = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                     0.17392742256872693};

/// ∫ Σᵢⱼ (∂²/∂uᵢ∂uⱼ)² of the basis over one of n₁ n₂ n₃ equal elements.
Eigen::Matrix<double, 64, 64> second_derivative_matrix(const Eigen::Vector3i& n) {
  Eigen::Matrix<double, 64, 64> m = Eigen::Matrix<double, 64, 64>::Zero();
  for (int q = 0; q < 64; ++q)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        std::array<int, 3> order = {0, 0, 0};
        ++order[i];
        ++order[j];
        const BasisRow row = basis_row({x[q % 4], x[q / 4 % 4], x[q / 16]}, order);
        const double scale = n[i] * n[j];
        m += w[q % 4] * w[q / 4 % 4] * w[q / 16] * scale * scale * row.transpose() * row;
      }
  return m / n.prod();
}

// In u, of which an element is a seventh by default. Without bends in the tether, a nipple's skin
// has many minima: data of 1 mm leave its cross-derivatives free.
constexpr double tethered_bends = 0.04;

/// ∫ of squared values and bends of the basis over the skin's face of one of n₁ n₂ equal elements.
Eigen::Matrix<double, 64, 64> skin_matrix(const Eigen::Vector3i& n) {
  Eigen::Matrix<double, 64, 64> m = Eigen::Matrix<double, 64, 64>::Zero();
  for (int q = 0; q < 16; ++q) {
    const Eigen::Vector3d at(x[q % 4], x[q / 4], 1);
    const BasisRow row = basis_row(at);
    m += w[q % 4] * w[q / 4] * row.transpose() * row;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        std::array<int, 3> order = {0, 0, 0};
        ++order[i];
        ++order[j];
        const double scale = tethered_bends * tethered_bends * n[i] * n[j];
        const BasisRow bend = scale * basis_row(at, order);
        m += w[q % 4] * w[q / 4] * bend.transpose() * bend;
      }
  }
  return m / (n.x() * n.y());
}

Eigen::Vector3d mean_position(const HermiteMesh& mesh) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const HermiteMesh::Node& node : mesh.nodes()) mean += node.col(0) / mesh.num_nodes();
  return mean;
}

}  // namespace

FitModel::FitModel(const Slab& slab, const HermiteMesh& start)
    : corners_(start.elements()),
      origin_(mean_position(start)),
      second_derivatives_(second_derivative_matrix(slab.elements)),
      tether_(skin_matrix(slab.elements)),
      tethered_to_(slab.elements.x() * slab.elements.y(), ElementShape::Zero()),
      shape_energy_(slab, start),
      shapes_(corners_.size()),
      samples_(corners_.size()) {}

void FitModel::tether(double weight, const std::vector<HermiteMesh::Node>& to) {
  tether_weight_ = weight;
  for (std::size_t face = 0; face < tethered_to_.size(); ++face)
    tethered_to_[face] = element_shape(to, corners_[first_at_skin() + face], origin_);
}

ElementShape FitModel::strayed(int e) const {
  return e < first_at_skin() ? ElementShape::Zero().eval()
                             : (shapes_[e] - tethered_to_[e - first_at_skin()]).eval();
}

void FitModel::move_to(const std::vector<HermiteMesh::Node>& nodes,
                       const std::vector<PlaneSample>& samples) {
  std::vector<std::vector<int>> of_element(corners_.size());
  for (std::size_t s = 0; s < samples.size(); ++s)
    of_element[samples[s].point.element].push_back(static_cast<int>(s));
  tbb::parallel_for(0, num_elements(), [&](int e) {
    shapes_[e] = element_shape(nodes, corners_[e], origin_);
    samples_[e] = PlaneSamples(samples, of_element[e], origin_);
  });
  shape_energy_.renew_epsilon(shapes_);
}

double FitModel::cost(int e) const {
  const ElementShape& x = shapes_[e];
  const double bending = (x * second_derivatives_).cwiseProduct(x).sum();
  const ElementShape moved = strayed(e);
  return tether_weight_ / 2 * (moved * tether_).cwiseProduct(moved).sum() +
         samples_[e].cost(x.reshaped()) + smoothing_weight_ / 2 * bending +
         shape_weight_ * shape_energy_.cost(x, e);
}

ElementQuadratic FitModel::quadratic(int e) const {
  const ElementShape& x = shapes_[e];
  ElementQuadratic result;
  shape_energy_.add(x, e, shape_weight_, result);
  const double tether = e < first_at_skin() ? 0 : tether_weight_;
  const ElementShape pull =
      smoothing_weight_ * x * second_derivatives_ + tether * strayed(e) * tether_;
  result.gradient += pull.reshaped();
  for (int c = 0; c < 3; ++c)
    result.hessian(Eigen::seqN(c, 64, 3), Eigen::seqN(c, 64, 3)) +=
        smoothing_weight_ * second_derivatives_ + tether * tether_;
  samples_[e].add(x.reshaped(), result);
  return result;
}

}  // namespace mammotwin
