#pragma once

#include <filesystem>

#include "segmentation/files/raw_image.h"

namespace mammotwin {

/// True for the extensions of NIfTI, NRRD and MetaImage.
bool is_image_file_name(const std::filesystem::path& path);

/// Lets the library read the header, as read_raw_image does, and throws what it throws; over some
/// files it ends the program or never ends (trial_read.h).
void try_raw_header(const std::filesystem::path& path);

/// Reads a three-dimensional scalar image of one of those formats; four dimensions only where the
/// fourth is 1. `components` values a voxel are expected, and lie together. `keys`, where given,
/// receives the header's key/value pairs. Throws std::runtime_error without the path, which the
/// caller adds.
RawImage read_raw_image(const std::filesystem::path& path, HeaderKeys* keys = nullptr,
                        int components = 1);

}  // namespace mammotwin
