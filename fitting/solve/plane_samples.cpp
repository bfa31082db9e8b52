#include "fitting/solve/plane_samples.h"

namespace mammotwin {

PlaneSamples::PlaneSamples(const std::vector<PlaneSample>& samples,
                           const std::vector<int>& of_element, const Eigen::Vector3d& origin) {
  Eigen::MatrixXd basis(of_element.size(), 64);
  for (std::size_t i = 0; i < of_element.size(); ++i)
    basis.row(i) = basis_row(samples[of_element[i]].point.xi);
  std::vector<int> seen;
  for (int p = 0; p < 64; ++p)
    if (!basis.col(p).isZero(0)) seen.push_back(p);

  for (int p : seen) parameters_.insert(parameters_.end(), {3 * p, 3 * p + 1, 3 * p + 2});
  a_.setZero(parameters_.size(), parameters_.size());
  b_.setZero(parameters_.size());
  Eigen::VectorXd row(parameters_.size());
  for (std::size_t i = 0; i < of_element.size(); ++i) {
    const PlaneSample& sample = samples[of_element[i]];
    for (std::size_t p = 0; p < seen.size(); ++p)
      row.segment<3>(3 * p) = basis(i, seen[p]) * sample.normal;
    const double goal = sample.normal.dot(sample.target - origin);
    a_.selfadjointView<Eigen::Lower>().rankUpdate(row, sample.weight);
    b_ += sample.weight * goal * row;
    c_ += (sample.weight * goal * goal + sample.beyond_square) / 2;
  }
  a_.triangularView<Eigen::StrictlyUpper>() = a_.transpose();
}

double PlaneSamples::cost(const ElementVector& x) const {
  const Eigen::VectorXd seen = x(parameters_);
  return 0.5 * seen.dot(a_ * seen) - b_.dot(seen) + c_;
}

void PlaneSamples::add(const ElementVector& x, ElementQuadratic& to) const {
  to.gradient(parameters_) += a_ * x(parameters_) - b_;
  to.hessian(parameters_, parameters_) += a_;
}

}  // namespace mammotwin
