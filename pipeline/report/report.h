#pragma once

#include <filesystem>
#include <string>

namespace mammotwin {

/// Writes one self-contained HTML page about a folder of results, whatever it holds.
/// Throws std::runtime_error if the folder is missing or the page cannot be written.
void write_report(const std::filesystem::path& results, const std::filesystem::path& page,
                  const std::string& version);

/// The same figures as one PNG sheet, for a README or a slide. No X server is needed.
void write_report_picture(const std::filesystem::path& results, const std::filesystem::path& png);

/// The sketch of all frames, as in registration/README.md.
void write_frames_picture(const std::filesystem::path& png);

}  // namespace mammotwin
