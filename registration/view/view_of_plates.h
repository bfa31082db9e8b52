#pragma once

#include <string>

#include "registration/view/compressed_view.h"
#include "solver/press/compress.h"

namespace mammotwin {

/// Origin of a view's frame where its plates stand [mm in LPS].
Eigen::Vector3d origin_of_plates(const PlateOptions& options, const PlacedPlates& placed);

/// A view from where its plates ended.
CompressedView view_of_plates(const std::string& name, Side side, double angle_deg, double turn_deg,
                              const PlateOptions& options, const CompressionResult& result);

}  // namespace mammotwin
