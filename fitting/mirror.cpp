#include "fitting/mirror.h"

#include <utility>

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/block_mesh.h"
#include "fitting/slab/slab.h"
#include "segmentation/mirrored.h"

namespace mammotwin {

namespace {

/// ξ₁ runs the other way, too: parameters that are differentiated along it change their sign twice
/// in x and once in y and z.
HermiteMesh::Node mirrored(const HermiteMesh::Node& node) {
  HermiteMesh::Node result = node;
  for (int d = 0; d < 8; ++d) {
    if (d & 1)
      result.bottomRows<2>().col(d) *= -1;
    else
      result(0, d) *= -1;
  }
  return result;
}

std::vector<HermiteMesh::Node> mirrored(const HermiteMesh& mesh, const Slab& slab) {
  const Eigen::Vector3i& n = slab.elements;
  std::vector<HermiteMesh::Node> nodes(mesh.num_nodes());
  for (int k = 0; k <= n.z(); ++k)
    for (int j = 0; j <= n.y(); ++j)
      for (int i = 0; i <= n.x(); ++i)
        nodes[slab.node(i, j, k)] = mirrored(mesh.node(slab.node(n.x() - i, j, k)));
  return nodes;
}

PointField mirrored(const PointField& field, const HermiteMesh& mesh, const Slab& slab) {
  const BezierMesh bezier(mesh);
  PointField result = field;
  const Eigen::Vector3i& n = slab.elements;
  for (int e = 0; e < mesh.num_elements(); ++e) {
    const int i = e % n.x();
    const auto& here = bezier.elements[e];
    const auto& there = bezier.elements[e - i + n.x() - 1 - i];
    for (int m = 0; m < 64; ++m)
      for (int c = 0; c < field.components; ++c)
        result.values[field.components * here[m] + c] =
            field.values[field.components * there[m - m % 4 + 3 - m % 4] + c];
  }
  return result;
}

}  // namespace

ScannedSkin mirrored(const ScannedSkin& scan) {
  ScannedSkin result = scan;
  for (auto& x : result.surface.vertices) x = mirrored(x);
  for (auto& t : result.surface.triangles) std::swap(t[1], t[2]);
  return result;
}

FitResult mirrored(const FitResult& fit) {
  FitResult result = fit;
  result.report.farthest_in_lps = mirrored(fit.report.farthest_in_lps);
  const HermiteMesh& mesh = fit.mesh.mesh;
  if (mesh.num_elements() == 0) return result;
  const Slab slab{fit.report.elements};
  result.mesh.mesh = HermiteMesh(mirrored(mesh, slab), grid_corners(slab.elements));
  for (auto& [name, field] : result.mesh.fields) field = mirrored(field, mesh, slab);
  return result;
}

}  // namespace mammotwin
