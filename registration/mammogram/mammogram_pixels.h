#pragma once

#include <filesystem>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// Grey values, dense tissue bright: MONOCHROME1 is turned over; detector counts (FOR PROCESSING)
/// become what was absorbed (detector_counts.h); padding becomes air. Of several frames the mean:
/// what a tomosynthesis volume shows from above. Uncompressed, RLE, JPEG and JPEG-LS files; colour
/// where red, green and blue are equal. Throws std::runtime_error, naming JPEG 2000 where it is
/// that.
MammogramImage read_mammogram_dicom(const std::filesystem::path& path);

/// The same of one slice, which count from 1.
MammogramImage read_mammogram_slice(const std::filesystem::path& path, int slice);

/// A DICOM file, PNG or JPEG (mammogram_picture.h).
MammogramImage read_mammogram(const std::filesystem::path& path);

}  // namespace mammotwin
