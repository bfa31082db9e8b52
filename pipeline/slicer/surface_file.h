#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/report/drawing/mesh_surface.h"

namespace mammotwin {

/// Numbers at a surface's points, by name; empty values: none.
struct PointNumbers {
  std::string name;
  std::vector<double> values;
};

/// Writes triangles as VTK's XML polygon data (.vtp), LPS in mm, which its field "SPACE" says to
/// 3D Slicer. Throws std::runtime_error if the file cannot be written.
void write_surface(const std::filesystem::path& path, const FaceTriangles& surface,
                   const PointNumbers& numbers = {});

}  // namespace mammotwin
