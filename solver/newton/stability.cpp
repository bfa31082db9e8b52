#include "solver/newton/stability.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

namespace mammotwin {

namespace {

using Vectors = std::vector<Eigen::VectorXd>;

/// Touches every mode; the generator's numbers are fixed by the standard.
Eigen::VectorXd start_vector(Eigen::Index size) {
  std::mt19937 numbers(1);
  Eigen::VectorXd v(size);
  for (Eigen::Index i = 0; i < size; ++i) v[i] = numbers() / double(numbers.max()) - 0.5;
  return v;
}

/// Twice, which is enough (Parlett, The Symmetric Eigenvalue Problem, section 6.9).
void orthogonalise(const Vectors& basis, const Vectors& images, Eigen::VectorXd& w) {
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < basis.size(); ++k) w -= images[k].dot(w) * basis[k];
}

}  // namespace

double smallest_stiffness(const Cholesky& factor, const SparsePattern& pattern,
                          const std::vector<double>& values) {
  constexpr int most_steps = 60;
  constexpr double precision = 0.01;
  const int steps = std::min(most_steps, pattern.num_columns());
  Vectors basis, images;  // q and M q, orthonormal in M
  Eigen::VectorXd diagonal(steps), beside(steps);
  Eigen::VectorXd q = factor.solve(start_vector(pattern.num_columns()));
  double softness = 0;
  for (int k = 0; k < steps; ++k) {
    Eigen::VectorXd image = multiply(pattern, values, q);
    const double norm = std::sqrt(q.dot(image));
    if (!(norm > 0)) break;  // the space is exhausted
    basis.push_back(q / norm);
    images.push_back(image / norm);
    q = factor.solve(images.back());
    diagonal[k] = images.back().dot(q);
    orthogonalise(basis, images, q);
    beside[k] = std::sqrt(std::max(0.0, q.dot(multiply(pattern, values, q))));
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(diagonal.head(k + 1), beside.head(k));
    softness = ritz.eigenvalues()[k];
    if (beside[k] * std::abs(ritz.eigenvectors()(k, k)) <= precision * softness) break;
  }
  return 1 / softness;
}

}  // namespace mammotwin
