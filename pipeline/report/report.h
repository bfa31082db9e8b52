#pragma once

#include <filesystem>
#include <string>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Writes one self-contained HTML page about results, whatever there is of them.
/// Throws std::runtime_error if the page cannot be written.
void write_report(const PatientResults& results, const std::filesystem::path& page,
                  const std::string& version);

/// The same figures as one PNG sheet, for a README or a slide. No X server is needed.
void write_report_picture(const PatientResults& results, const std::filesystem::path& png);

/// The sketch of all frames, as in registration/README.md.
void write_frames_picture(const std::filesystem::path& png);

}  // namespace mammotwin
