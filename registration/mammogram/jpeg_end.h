#pragma once

#include <filesystem>

namespace mammotwin {

/// False where a JPEG file ends before its image does: libjpeg goes on in grey, without a word.
/// Walks the segments to the marker EOI (ITU-T T.81, B.1.1); what follows it does not matter.
bool has_jpeg_end(const std::filesystem::path& path);

}  // namespace mammotwin
