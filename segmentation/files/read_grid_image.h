#pragma once

#include <filesystem>

#include "segmentation/files/grid_image.h"
#include "segmentation/files/raw_image.h"

namespace mammotwin {

/// Throws std::runtime_error, without the path, unless a folder or a file with something in it lies
/// there: a pipe or a device may never end.
void check_is_there(const std::filesystem::path& path);

/// Reads NIfTI, NRRD or MetaImage as it lies in the file, and its header's `keys`, where wanted.
/// Throws as read_raw_image does.
GridImage read_grid_image(const std::filesystem::path& path, HeaderKeys* keys = nullptr);

}  // namespace mammotwin
