#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Draws the axial, coronal and sagittal slice through a point, side by side, white at `white`,
/// as a grey PNG. Throws std::runtime_error if the file cannot be written.
void write_slices(const std::filesystem::path& path, const Volume<std::int16_t>& image,
                  const Eigen::Vector3d& point_in_lps, double white);

}  // namespace mammotwin
