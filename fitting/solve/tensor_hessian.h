#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace mammotwin {

/// Σ_q Gᵀ T G of one tri-cubic Hermite element by sum factorisation: q runs through a grid of
/// points, G is the gradient ∂x/∂ξ by the element's parameters, T a symmetric tensor at a point.
/// A grid of n³ points takes 864 n³ + 13824 n² + 98304 n products instead of 73728 n³.
class TensorHessian {
 public:
  static constexpr int num_pairs = 6;

  /// Number of the pair of components (c, b), b ≤ c.
  static int pair(int c, int b) { return c * (c + 1) / 2 + b; }

  /// `points` in [0,1] along each ξ; derivatives along ξᵢ₊₁ are divided by `lengths[i]`.
  TensorHessian(const std::vector<double>& points, const Eigen::Vector3d& lengths);

  /// Point q of the grid; ξ₁ varies slowest.
  Eigen::Vector3d point(int q) const;
  int num_points() const { return n_ * n_ * n_; }

  /// Where T's entry between ∂x_c/∂ξᵢ₊₁ and ∂x_b/∂ξⱼ₊₁ at point q stands in what `add` takes.
  int place(int i, int j, int q) const { return ((i + 3 * j) * num_points() + q) * num_pairs; }
  int num_entries() const { return 9 * num_points() * num_pairs; }

  /// Adds the sum to a 192 x 192 matrix; row 24·corner + 3·parameter + component.
  void add(const std::vector<double>& tensors, Eigen::MatrixXd& hessian) const;

 private:
  /// Products of two one-dimensional functions a and a' at point q: entry 16 q + 4 a + a'.
  using Table = std::vector<double>;
  const Table& table(int direction, int i, int j) const {
    return tables_[direction][2 * (i == direction) + (j == direction)];
  }

  int n_;
  std::vector<double> points_;
  std::array<std::array<Table, 4>, 3> tables_;  ///< of a direction; bit 1: a' differentiated, bit 0
};

}  // namespace mammotwin
