#pragma once

#include <filesystem>

namespace mammotwin {

/// Looks through a MetaImage header before the library does: MetaIO 5.2 copies each field into 255
/// bytes unasked, and a damaged header ends the program. Throws std::runtime_error, without the
/// path, where a line up to ElementDataFile is no "Name = value" of printable characters, is too
/// long, or ElementDataFile does not come.
void check_meta_header(const std::filesystem::path& path);

}  // namespace mammotwin
