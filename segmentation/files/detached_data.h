#pragma once

#include <filesystem>
#include <optional>

namespace mammotwin {

/// The file that holds the voxels where `path` is but their header (.mhd, .nhdr); empty for an
/// image in one file, and for a format without such headers. Throws std::runtime_error naming the
/// header where it cannot be read, or spreads its voxels over several files.
std::optional<std::filesystem::path> detached_data_file(const std::filesystem::path& path);

}  // namespace mammotwin
