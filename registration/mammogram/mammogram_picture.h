#pragma once

#include <filesystem>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// True where a file begins as PNG or JPEG files do.
bool is_mammogram_picture(const std::filesystem::path& path);

/// Reads a PNG (8 or 16 bit) or JPEG as exports are: grey, or colour of which red, green and blue
/// are equal but for what compression leaves; how opaque it is does not matter. Throws
/// std::runtime_error naming the file and what is wrong.
MammogramImage read_mammogram_picture(const std::filesystem::path& path);

/// Columns and rows, without reading the greys.
struct PictureSize {
  int columns = 0, rows = 0;
};
PictureSize mammogram_picture_size(const std::filesystem::path& path);

}  // namespace mammotwin
