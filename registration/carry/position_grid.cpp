#include "registration/carry/position_grid.h"

#include <tbb/parallel_for.h>

#include <limits>
#include <optional>
#include <utility>

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/inverse_map.h"

namespace mammotwin {

namespace {

/// Where a walk through one element goes next.
MeshPoint ahead(const MeshPoint& p, const std::optional<MeshPoint>& before) {
  if (!before || before->element != p.element) return p;
  return {p.element, 2 * p.xi - before->xi};
}

}  // namespace

void fill_positions(const HermiteMesh& here, const HermiteMesh& target, PositionGrid& grid) {
  const InverseMap inverse(here);
  const Eigen::Vector3d outside =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto fill_row = [&](int j, int k) {
    std::optional<MeshPoint> p, before;
    for (int i = 0; i < grid.size.x(); ++i) {
      const Eigen::Vector3d x = grid.position(i, j, k);
      const std::optional<MeshPoint> next =
          p ? inverse.locate(x, ahead(*p, before)) : inverse.locate(x);
      before = std::exchange(p, next);
      grid(i, j, k) = p ? target.position(*p) : outside;
    }
  };
  tbb::parallel_for(0, grid.size.y() * grid.size.z(),
                    [&](int row) { fill_row(row % grid.size.y(), row / grid.size.y()); });
}

HermiteMesh in_view_frame(const HermiteMesh& mesh, const ViewFrame& frame) {
  std::vector<HermiteMesh::Node> nodes = mesh.nodes();
  for (HermiteMesh::Node& node : nodes) {
    node.col(0) -= frame.origin_in_lps;
    node = (frame.axes * node).eval();
  }
  return HermiteMesh(std::move(nodes), mesh.elements());
}

Eigen::AlignedBox3d bounding_box(const HermiteMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const BezierElement points = bezier_element(mesh, e);
    box.extend(points.rowwise().minCoeff().eval());
    box.extend(points.rowwise().maxCoeff().eval());
  }
  return box;
}

PositionGrid cover(const Eigen::AlignedBox3d& box, double spacing_mm) {
  const Eigen::Vector3i size =
      (box.sizes() / spacing_mm).array().ceil().cast<int>().max(1).matrix();
  const Eigen::Vector3d spacing = Eigen::Vector3d::Constant(spacing_mm);
  return PositionGrid(size, spacing, box.min() + spacing / 2, Eigen::Vector3d::Zero());
}

}  // namespace mammotwin
