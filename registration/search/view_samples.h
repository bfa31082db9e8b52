#pragma once

#include <vector>

#include "registration/search/reduced_view.h"

namespace mammotwin {

/// Material points of a reduced view, ready to be placed at any state.
class ViewSamples {
 public:
  using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

  /// `offsets` [mm, view frame] are carried along unchanged: of points outside the mesh; or empty.
  ViewSamples(const ReducedView& view, const std::vector<MeshPoint>& points,
              const std::vector<Eigen::Vector3d>& offsets = {});

  /// In the view's frame, turn and shifts included [mm].
  Points at(const ReducedView& view, const ViewState& z) const;

  /// After ReducedView::rebase.
  void renew(const ReducedView& view);

 private:
  Points sample(const ReducedView& view, const Nodes& nodes) const;

  std::vector<MeshPoint> points_;
  Points offsets_, base_;
  std::array<Points, kMechanical> linear_, quadratic_;
};

}  // namespace mammotwin
