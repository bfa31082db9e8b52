#include "registration/search/view_samples.h"

namespace mammotwin {

ViewSamples::ViewSamples(const ReducedView& view, const std::vector<MeshPoint>& points,
                         const std::vector<Eigen::Vector3d>& offsets)
    : points_(points), offsets_(Points::Zero(3, points.size())) {
  for (std::size_t n = 0; n < offsets.size(); ++n) offsets_.col(n) = offsets[n];
  for (int i = 0; i < kMechanical; ++i) {
    if (view.modes[i].linear.empty()) continue;
    linear_[i] = sample(view, view.modes[i].linear);
    quadratic_[i] = sample(view, view.modes[i].quadratic);
  }
  renew(view);
}

void ViewSamples::renew(const ReducedView& view) { base_ = sample(view, view.base) + offsets_; }

ViewSamples::Points ViewSamples::sample(const ReducedView& view, const Nodes& nodes) const {
  const HermiteMesh mesh(nodes, view.elements);
  Points x(3, points_.size());
  for (std::size_t n = 0; n < points_.size(); ++n) x.col(n) = mesh.position(points_[n]);
  return x;
}

ViewSamples::Points ViewSamples::at(const ReducedView& view, const ViewState& z) const {
  Points x = base_;
  for (int i = 0; i < kMechanical; ++i) {
    if (linear_[i].size() == 0 || z[i] == 0) continue;
    x += z[i] * linear_[i] + z[i] * z[i] * quadratic_[i];
  }
  for (Eigen::Index n = 0; n < x.cols(); ++n) x.col(n) = view.placed(x.col(n), z);
  return x;
}

}  // namespace mammotwin
