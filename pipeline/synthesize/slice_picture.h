#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "registration/export/png_file.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// The axial, coronal and sagittal slice through a point, side by side, white at `white`.
GreyPixels slice_picture(const Volume<std::int16_t>& image, const Eigen::Vector3d& point_in_lps,
                         double white);

}  // namespace mammotwin
