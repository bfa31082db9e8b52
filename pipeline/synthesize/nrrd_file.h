#pragma once

#include <cstdint>
#include <filesystem>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Writes a gzip-compressed NRRD in LPS [mm] that ITK and 3D Slicer read. Its bytes depend on the
/// values and the version of zlib only, as the sums kept of samples and patients want it: ITK's
/// writer (segmentation/files/write_image_file.h) has a header of its own that comes and goes with
/// ITK. Throws std::runtime_error if the file cannot be written.
void write_nrrd(const std::filesystem::path& path, const Volume<std::int16_t>& image);
void write_nrrd(const std::filesystem::path& path, const Volume<std::uint8_t>& labels);

}  // namespace mammotwin
