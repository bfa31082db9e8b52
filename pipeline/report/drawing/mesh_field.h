#pragma once

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/mesh_file.h"

namespace mammotwin {

/// Reads a field of a mesh file anywhere in the mesh.
class MeshField {
 public:
  /// Throws std::invalid_argument where the field has not one value a control point.
  MeshField(const HermiteMesh& mesh, PointField field);

  double at(const MeshPoint& point) const;

 private:
  BezierMesh bezier_;
  PointField field_;
};

}  // namespace mammotwin
