#include "fitting/solve/fit_point.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fitting/mesh/jacobian_bound.h"

namespace mammotwin {

namespace {

// In the end elements that have the scaled Jacobian needed keep it, others lose a tenth of theirs a
// step at most.
constexpr double kept_part = 0.9;
// [mm²], beside costs of order 1.
constexpr double refused_cost = 1e6;
// Of the Hessian's diagonal: an element without data costs nothing to translate, and rounding
// (192 products of 1e-16) must not make that negative.
constexpr double relative_shift = 1e-9;

bool keeps_shape(const std::vector<double>& before, const std::vector<double>& after) {
  return std::equal(after.begin(), after.end(), before.begin(), [](double now, double then) {
    return now >= (then < needed_scaled_jacobian ? kept_part * then : needed_scaled_jacobian);
  });
}

FitPoint::Condensed condense(ElementQuadratic quadratic) {
  quadratic.hessian.diagonal() *= 1 + relative_shift;
  quadratic.hessian.diagonal().array() += relative_shift * relative_shift;
  Eigen::LLT<ElementMatrix> cholesky(quadratic.hessian);
  if (cholesky.info() != Eigen::Success)
    throw std::runtime_error("fit: an element's Hessian is not finite (are the skin's points?)");
  FitPoint::Condensed condensed{quadratic.gradient, cholesky.matrixLLT()};
  cholesky.matrixL().solveInPlace(condensed.residuals);
  return condensed;
}

}  // namespace

FitPoint::FitPoint(const Slab& slab, const HermiteMesh& start, FitTarget& target)
    : elements_(start.elements()),
      target_(target),
      model_(slab, start),
      condensed_(elements_.size()) {}

void FitPoint::demand(MeshDemand demand, const HermiteMesh& mesh) {
  demand_ = demand;
  if (demand == MeshDemand::proved_in_shape) shape_to_keep_ = scaled_jacobians(mesh);
}

bool FitPoint::as_demanded(const HermiteMesh& mesh) const {
  if (demand_ == MeshDemand::none) return true;
  if (demand_ == MeshDemand::proved_in_shape &&
      !keeps_shape(shape_to_keep_, scaled_jacobians(mesh)))
    return false;
  return proved_valid(mesh);
}

void FitPoint::move_to(const std::vector<HermiteMesh::Node>& nodes) {
  const HermiteMesh mesh(nodes, elements_);
  refused_ = !as_demanded(mesh);
  cost_ = refused_cost;
  if (!refused_) {
    model_.move_to(nodes, target_.samples(mesh, weights_));
    std::vector<double> costs(elements_.size());
    tbb::parallel_for(0, static_cast<int>(costs.size()), [&](int e) { costs[e] = model_.cost(e); });
    cost_ = std::accumulate(costs.begin(), costs.end(), 0.0);
  }
  remaining_residual_ = std::sqrt(2 * cost_);
}

void FitPoint::linearise() {
  tbb::parallel_for(0, static_cast<int>(elements_.size()),
                    [&](int e) { condensed_[e] = condense(model_.quadratic(e)); });
  double rest = 2 * cost_;
  for (const Condensed& element : condensed_) rest -= element.residuals.squaredNorm();
  remaining_residual_ = std::sqrt(std::max(0.0, rest));
}

}  // namespace mammotwin
