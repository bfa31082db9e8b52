#pragma once

#include <filesystem>

#include "fitting/mesh/mesh_file.h"
#include "fitting/surface/closest_point.h"

namespace mammotwin {

/// The skin of the same breast as seen in another pose: how far a deformed mesh lies from it.
class SecondState {
 public:
  /// Reads a surface (PLY, STL, OBJ, OFF) or a label map (0 is air). `mesh` says which faces are
  /// skin; elements beside a cut are left out, for there nobody knows where the breast ends.
  SecondState(const std::filesystem::path& path, const MeshFile& mesh);

  /// RMS distance of the skin's points to the surface [mm].
  double distance(const std::vector<HermiteMesh::Node>& deformed) const;

 private:
  ClosestPoint closest_;
  std::vector<HermiteMesh::Corners> elements_;
  std::vector<MeshPoint> skin_;
};

}  // namespace mammotwin
