#pragma once

#include <array>
#include <utility>
#include <vector>

#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// One face of one element; faces in the order xi1 = 0, xi1 = 1, xi2 = 0, ..., xi3 = 1.
struct ElementFace {
  int element;
  int face;
  FaceLabel label;
};

/// Faces that belong to one element only, with their labels (interior where the file has none).
std::vector<ElementFace> outer_faces(const MeshFile& file);

/// Those of them that are skin.
std::vector<ElementFace> skin_faces(const MeshFile& file);

/// Every face of the mesh once, those between two elements included.
std::vector<ElementFace> all_faces(const MeshFile& file);

/// Point of a face at (s, t) in [0,1]^2; the face's normal d/ds x d/dt points out of the element.
MeshPoint point_on_face(const ElementFace& face, double s, double t);

/// Pieces of the curves in which the plane {x : x[axis] = at} cuts the faces, each face seen as
/// `samples` x `samples` squares.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> cut_by_plane(
    const HermiteMesh& mesh, const std::vector<ElementFace>& faces, int axis, double at,
    int samples = 10);

/// The faces as a triangle mesh for drawing.
struct FaceTriangles {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise from outside
  std::vector<FaceLabel> labels;              ///< one a triangle
};
FaceTriangles triangulate(const HermiteMesh& mesh, const std::vector<ElementFace>& faces,
                          int samples);

}  // namespace mammotwin
