#pragma once

#include "pipeline/patient/patient.h"

namespace mammotwin {

/// The view's mammogram where it is a DICOM file. Throws std::runtime_error naming the setting
/// where it is named and is neither that nor a PNG.
std::optional<std::filesystem::path> dicom_mammogram(const Patient& patient,
                                                     const std::string& view);

/// What patient.toml says of a view, and where it says nothing, what the header of its DICOM
/// mammogram does. Remarks name tags that are missing or odd. Throws std::runtime_error naming file
/// and tag where the mammogram cannot serve (registration/mammogram/header_geometry.h).
ViewSettings with_header(const Patient& patient, const std::string& view, Side side,
                         std::vector<std::string>& remarks);

}  // namespace mammotwin
