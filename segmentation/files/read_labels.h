#pragma once

#include <cstdint>
#include <filesystem>

#include "segmentation/files/raw_image.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// Reads a label map (NIfTI, NRRD or MetaImage) onto the LPS grid, and its header's `keys`, where
/// wanted. Values must be whole, 0 to 65535. Throws std::runtime_error naming the path, what was
/// expected and what was found.
Volume<std::uint16_t> read_labels(const std::filesystem::path& path, HeaderKeys* keys = nullptr);

}  // namespace mammotwin
