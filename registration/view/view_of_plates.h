#pragma once

#include <string>

#include "registration/view/compressed_view.h"
#include "solver/press/compress.h"

namespace mammotwin {

/// Frame of a view from where its plates ended.
CompressedView view_of_plates(const std::string& name, Side side, double angle_deg, double turn_deg,
                              const PlateOptions& options, const CompressionResult& result);

}  // namespace mammotwin
