#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mammotwin {

/// Grid of an image file, in plain arrays (see raw_image.h); axes along LPS.
struct FileGrid {
  std::array<int, 3> size;
  std::array<double, 3> spacing;  ///< [mm]
  std::array<double, 3> origin;   ///< LPS [mm]
};

/// Writes NRRD, gzip compressed, space left-posterior-superior, with `keys` as key/value pairs.
/// `components` values a voxel; more than one are written as a vector. Throws std::runtime_error
/// naming the path if it cannot be written.
void write_nrrd(const std::filesystem::path& path, const FileGrid& grid, const float* values,
                int components, const std::map<std::string, std::string>& keys);
void write_nrrd(const std::filesystem::path& path, const FileGrid& grid, const std::uint8_t* values,
                int components, const std::map<std::string, std::string>& keys);

/// The same as compressed NIfTI (.nii.gz), whose coordinates are RAS as its standard has it.
void write_nifti(const std::filesystem::path& path, const FileGrid& grid, const float* values);
void write_nifti(const std::filesystem::path& path, const FileGrid& grid,
                 const std::uint8_t* values);

}  // namespace mammotwin
