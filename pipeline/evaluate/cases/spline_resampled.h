#pragma once

#include <functional>

#include "segmentation/image/volume.h"

namespace mammotwin {

enum class Beyond {
  zero,    ///< nothing lies beyond the image
  border,  ///< what its border shows goes on
};

/// The image on the grid of `onto`, whose place x [mm, LPS] shows what stands at `from(x)`: a cubic
/// spline through the grey values, not below zero.
Volume<float> spline_resampled(const Volume<float>& image, Volume<float> onto,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& from,
                               Beyond beyond = Beyond::zero);

}  // namespace mammotwin
