#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "segmentation/raw_image.h"

namespace mammotwin {

/// True for the extensions of NIfTI, NRRD and MetaImage.
bool is_image_file_name(const std::filesystem::path& path);

/// Reads a three-dimensional scalar image of one of those formats; four dimensions only where the
/// fourth is 1. `keys`, where given, receives the header's key/value pairs.
/// Throws std::runtime_error without the path, which the caller adds.
RawImage read_image_file(const std::filesystem::path& path,
                         std::map<std::string, std::string>* keys = nullptr);

}  // namespace mammotwin
