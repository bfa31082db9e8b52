#include "pipeline/validation/gel_cylinder/gel_cylinder_mesh.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace mammotwin {

namespace {

/// Elements of a mesh whose middle has x >= least_x and y >= 0, nodes renumbered, ties kept.
MeshFile cut_out(const MeshFile& whole, double least_x) {
  std::vector<int> index(whole.mesh.num_nodes(), -1);
  std::vector<HermiteMesh::Node> nodes;
  std::vector<HermiteMesh::Corners> elements;
  MeshFile part{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  for (int e = 0; e < whole.mesh.num_elements(); ++e) {
    const Eigen::Vector3d middle = whole.mesh.position({e, {0.5, 0.5, 0.5}});
    if (middle.x() < least_x || middle.y() < 0) continue;
    HermiteMesh::Corners corners = whole.mesh.corners(e);
    for (int& corner : corners) {
      if (index[corner] < 0) {
        index[corner] = static_cast<int>(nodes.size());
        nodes.push_back(whole.mesh.node(corner));
      }
      corner = index[corner];
    }
    elements.push_back(corners);
    part.faces.push_back(whole.faces[e]);
  }
  part.mesh = HermiteMesh(std::move(nodes), std::move(elements));
  for (ParameterTie tie : whole.ties) {
    tie.node = index[tie.node];
    tie.to_node = index[tie.to_node];
    if (tie.node >= 0 && tie.to_node >= 0) part.ties.push_back(tie);
  }
  return part;
}

bool in_plane(const HermiteMesh& mesh, int e, int face, int axis, double value) {
  for (int c = 0; c < 8; ++c)
    if ((c >> (face / 2) & 1) == face % 2 &&
        std::abs(mesh.node(mesh.corners(e)[c])(axis, 0) - value) > kOnPlane)
      return false;
  return true;
}

template <class Keep>
FaceList faces_where(const HermiteMesh& mesh, Keep keep) {
  FaceList faces;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      if (keep(e, face)) faces.push_back({e, face});
  return faces;
}

}  // namespace

MeshFile cylinder_part(double diameter, double length, const CylinderElements& elements,
                       CylinderPart part) {
  if (elements.square % 2 != 0)
    throw std::invalid_argument("gel cylinder: the square's elements must be even in number");
  const double radius = diameter / 2;
  if (part == CylinderPart::eighth) return cut_out(cylinder_mesh(radius, length / 2, elements), 0);
  if (elements.length_grading != 1)
    throw std::invalid_argument("gel cylinder: the half is not graded along the axis");
  CylinderElements both = elements;
  both.length *= 2;
  MeshFile file = cut_out(cylinder_mesh(radius, length, both), -radius);
  std::vector<HermiteMesh::Node> nodes = file.mesh.nodes();
  for (auto& node : nodes) node(2, 0) -= length / 2;
  file.mesh = HermiteMesh(std::move(nodes), file.mesh.elements());
  return file;
}

FaceList faces_in_plane(const HermiteMesh& mesh, int axis, double value) {
  return faces_where(mesh, [&](int e, int face) { return in_plane(mesh, e, face, axis, value); });
}

FaceList faces_with_label(const MeshFile& file, FaceLabel label) {
  return faces_where(file.mesh, [&](int e, int face) { return file.faces[e][face] == label; });
}

int node_at(const HermiteMesh& mesh, const Eigen::Vector3d& X) {
  int nearest = 0;
  for (int i = 1; i < mesh.num_nodes(); ++i)
    if ((mesh.node(i).col(0) - X).norm() < (mesh.node(nearest).col(0) - X).norm()) nearest = i;
  return nearest;
}

}  // namespace mammotwin
