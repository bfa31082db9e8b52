#pragma once

#include <cstdint>
#include <filesystem>

namespace mammotwin {

/// How many bytes a zlib or gzip stream that begins at byte `offset` of a file unpacks to; it is
/// followed as far as it is whole, and no farther than `enough`. Throws std::runtime_error, without
/// the path, where the file cannot be opened.
std::uintmax_t unpacked_size(const std::filesystem::path& path, std::uintmax_t offset,
                             std::uintmax_t enough);

}  // namespace mammotwin
