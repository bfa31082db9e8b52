#pragma once

#include "pipeline/patient/patient.h"
#include "registration/mammogram/header_geometry.h"
#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

/// The view's mammogram where it is a DICOM file. Throws std::runtime_error naming the setting
/// where it is named and is neither that nor a picture (PNG or JPEG).
std::optional<std::filesystem::path> dicom_mammogram(const Patient& patient,
                                                     const std::string& view);

/// Reads the view's mammogram, if one is named, to its end: where nothing is searched in it, nobody
/// else does. Throws std::runtime_error where it cannot be read.
void require_whole_mammogram(const Patient& patient, const std::string& view);

/// What patient.toml says in place of a header.
HeaderOverrides overrides_of(const ViewSettings& view);

/// What patient.toml says in place of findings: `nipple_pixel`, `pectoral`, `outline` (a mask as
/// PNG, or a contour as text, column and row a line). Throws std::runtime_error naming the file.
SaidFindings said_in(const Patient& patient, const ViewSettings& view);

/// What patient.toml says of a view, and where it says nothing, what the header of its DICOM
/// mammogram does. Remarks name tags that are missing or odd. Throws std::runtime_error naming file
/// and tag where the mammogram cannot serve (registration/mammogram/header_geometry.h).
ViewSettings with_header(const Patient& patient, const std::string& view, Side side,
                         std::vector<std::string>& remarks);

}  // namespace mammotwin
