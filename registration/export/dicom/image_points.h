#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/ofstd/oftypes.h>

#include <vector>

#include "registration/export/dicom/dicom_export.h"

namespace mammotwin::dicom {

/// Column and row of each detector position, one after the other, as DICOM counts them: from 1 at
/// the first pixel's centre.
std::vector<Float32> on_image(const Detector& detector, const std::vector<Eigen::Vector2d>& uv);

/// Ends of the major, then of the minor axis, as the graphic type ELLIPSE has it.
std::vector<Eigen::Vector2d> ends_of(const AnnotatedMark& mark);

}  // namespace mammotwin::dicom
