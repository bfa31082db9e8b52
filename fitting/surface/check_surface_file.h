#pragma once

#include <filesystem>

namespace mammotwin {

/// Refuses a PLY or OFF file over whose header CGAL's readers end the program or ask for memory
/// without end: a property of no element, more points or faces than the file has bytes. Says
/// nothing of other files.
/// @throws std::runtime_error naming the file and what was found and expected
void check_surface_file(const std::filesystem::path& path);

}  // namespace mammotwin
