#pragma once

#include <cstdint>
#include <filesystem>

namespace mammotwin {

/// What the voxel part of a NIfTI file really holds.
struct NiftiVoxels {
  std::uintmax_t bytes = 0;       ///< after decompression
  std::uintmax_t not_finite = 0;  ///< NaN or infinite values, where values are floating point
};

/// ITK ends the program over an orientation that is not finite, and may search without an end over
/// a wild one. Throws std::runtime_error, without the path, naming the field (qform or sform, where
/// its code says that it counts) whose numbers are not finite or beyond what a scanner has.
void check_nifti_placement(const std::filesystem::path& path);

/// Reads the voxels of a .nii or .nii.gz file once, in pieces. `value_bytes`: 4 or 8 where
/// `floating`. Stops once `enough_bytes` are seen, however much is packed behind. Throws
/// std::runtime_error if the file cannot be opened or has no NIfTI header.
NiftiVoxels inspect_nifti(const std::filesystem::path& path, int value_bytes, bool floating,
                          std::uintmax_t enough_bytes);

}  // namespace mammotwin
