#pragma once

#include <Eigen/Core>
#include <optional>

#include "registration/mammogram/mammogram_image.h"

namespace mammotwin {

/// Centre (column, row) of the one round metal marker of 1 to 5 mm in a mammogram: a disc as bright
/// as anything in it. Empty where there is none, or more than one: neither is surely the nipple's.
std::optional<Eigen::Vector2d> find_marker(const MammogramImage& image, double pixel_mm);

}  // namespace mammotwin
