#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fitting/mesh/block_mesh.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {

/// A box of 4 x 3 x 2 elements on a flat chest wall at y = 0, and the same box squeezed: a stand-in
/// for a breast and its compression whose every position is known in closed form.
struct SqueezedBox {
  Side side;
  HermiteMesh prone;
  Eigen::Matrix3d A;  ///< compressed = A prone + b
  Eigen::Vector3d b;
  HermiteMesh compressed;
  CompressedView view;
};

/// Squeezes the box along the view's beam by `ratio` and stretches it in plane so that its volume
/// stays; the support is at height 0 and the detector's edge on the chest wall.
inline SqueezedBox squeezed_box(Side side, double angle_deg, double ratio) {
  HermiteMesh prone = side == Side::left ? block_mesh({20, -60, -40}, {120, 0, 40}, {4, 3, 2})
                                         : block_mesh({-120, -60, -40}, {-20, 0, 40}, {4, 3, 2});
  const Eigen::Matrix3d axes = view_axes(side, angle_deg);
  const double stretch = 1 / std::sqrt(ratio);
  const Eigen::Matrix3d A =
      axes.transpose() * Eigen::Vector3d(stretch, stretch, ratio).asDiagonal() * axes;
  const Eigen::Vector3d middle(side == Side::left ? 70 : -70, 0, 0);
  const Eigen::Vector3d b = middle - A * middle;

  std::vector<HermiteMesh::Node> nodes = prone.nodes();
  double low = 1e9, high = -1e9;
  for (HermiteMesh::Node& node : nodes) {
    node = (A * node).eval();
    node.col(0) += b;
    const double height = axes.row(2) * (node.col(0) - middle);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  CompressedView view{angle_deg == 0 ? "cc" : "mlo", side, angle_deg, high - low, {}};
  view.frame.axes = axes;
  view.frame.origin_in_lps = middle + axes.transpose() * Eigen::Vector3d(0, 0, low);
  HermiteMesh compressed(nodes, prone.elements());
  return {side, std::move(prone), A, b, std::move(compressed), view};
}

}  // namespace mammotwin
