#include "pipeline/report/drawing/mesh_surface.h"

#include <algorithm>
#include <map>
#include <optional>

namespace mammotwin {
namespace {

constexpr int kFaces = 6;

std::array<int, 4> face_nodes(const HermiteMesh& mesh, int element, int face) {
  const int axis = face / 2, end = face % 2;
  std::array<int, 4> nodes;
  int count = 0;
  for (int corner = 0; corner < 8; ++corner)
    if ((corner >> axis & 1) == end) nodes[count++] = mesh.corners(element)[corner];
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<ElementFace> faces_used(const MeshFile& file, bool outer_only) {
  const HermiteMesh& mesh = file.mesh;
  std::map<std::array<int, 4>, int> uses;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int f = 0; f < kFaces; ++f) ++uses[face_nodes(mesh, e, f)];
  std::vector<ElementFace> faces;
  for (int e = 0; e < mesh.num_elements(); ++e)
    for (int f = 0; f < kFaces; ++f) {
      int& count = uses[face_nodes(mesh, e, f)];
      if (count == 0 || (outer_only && count != 1)) continue;
      faces.push_back({e, f, file.faces.empty() ? FaceLabel::interior : file.faces[e][f]});
      count = 0;
    }
  return faces;
}

using Piece = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

std::optional<Piece> cut_triangle(const std::array<Eigen::Vector3d, 3>& x, int axis, double at) {
  std::array<Eigen::Vector3d, 3> ends;
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = x[i], &b = x[(i + 1) % 3];
    const double da = a[axis] - at, db = b[axis] - at;
    if ((da < 0) != (db < 0)) ends[count++] = a + (b - a) * (da / (da - db));
  }
  if (count != 2) return std::nullopt;
  return Piece{ends[0], ends[1]};
}

}  // namespace

std::vector<ElementFace> outer_faces(const MeshFile& file) { return faces_used(file, true); }
std::vector<ElementFace> skin_faces(const MeshFile& file) {
  std::vector<ElementFace> faces = outer_faces(file);
  std::erase_if(faces, [](const ElementFace& f) { return f.label != FaceLabel::skin; });
  return faces;
}
std::vector<ElementFace> all_faces(const MeshFile& file) { return faces_used(file, false); }

MeshPoint point_on_face(const ElementFace& face, double s, double t) {
  const int axis = face.face / 2, end = face.face % 2;
  if (end == 0) std::swap(s, t);  // keeps the normal outward
  MeshPoint p{face.element, Eigen::Vector3d::Zero()};
  p.xi[axis] = end;
  p.xi[(axis + 1) % 3] = s;
  p.xi[(axis + 2) % 3] = t;
  return p;
}

FaceTriangles triangulate(const HermiteMesh& mesh, const std::vector<ElementFace>& faces,
                          int samples) {
  FaceTriangles surface;
  for (const ElementFace& face : faces) {
    const int first = static_cast<int>(surface.points.size());
    for (int j = 0; j <= samples; ++j)
      for (int i = 0; i <= samples; ++i)
        surface.points.push_back(
            mesh.position(point_on_face(face, double(i) / samples, double(j) / samples)));
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        const int a = first + j * (samples + 1) + i, b = a + 1, c = a + samples + 1, d = c + 1;
        surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {a, d, c}});
        surface.labels.insert(surface.labels.end(), 2, face.label);
      }
  }
  return surface;
}

std::vector<Piece> cut_by_plane(const HermiteMesh& mesh, const std::vector<ElementFace>& faces,
                                int axis, double at, int samples) {
  const FaceTriangles surface = triangulate(mesh, faces, samples);
  std::vector<Piece> pieces;
  for (const auto& [a, b, c] : surface.triangles)
    if (const auto piece =
            cut_triangle({surface.points[a], surface.points[b], surface.points[c]}, axis, at))
      pieces.push_back(*piece);
  return pieces;
}

}  // namespace mammotwin
