#pragma once

#include <filesystem>

#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// Reads a surface in PLY, STL, OBJ or OFF; polygons are cut into triangles. Coordinates are taken
/// as patient LPS in mm. Throws std::runtime_error naming the file where it cannot be read, holds
/// no triangle or a number that is not finite.
TriangleSurface read_surface(const std::filesystem::path& path);

}  // namespace mammotwin
