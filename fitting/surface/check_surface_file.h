#pragma once

#include <filesystem>

namespace mammotwin {

/// Refuses what CGAL's readers would end the program over, or ask for memory without end: in PLY a
/// property of no element, more points or faces than the file has bytes; OFF that is binary, not of
/// points in space or short of lines. Says nothing of files with other endings.
/// @throws std::runtime_error naming the file and what was found and expected
void check_surface_file(const std::filesystem::path& path);

}  // namespace mammotwin
