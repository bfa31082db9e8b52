#pragma once

#include <filesystem>

namespace mammotwin {

/// Refuses a `.vtu` file over which VTK 9.1 ends the program or asks for memory without end: XML
/// that is not whole, two arrays of one name in a section, a count that the file cannot hold.
/// @throws std::runtime_error naming the file and what was found and expected
void check_vtu(const std::filesystem::path& path);

}  // namespace mammotwin
