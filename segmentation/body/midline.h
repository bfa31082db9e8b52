#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// x [mm, LPS] of the valley between two breasts in the labels; empty if there are not two.
std::optional<double> find_midline(const Volume<std::uint8_t>& labels);

/// True if a point is on that side of the midline.
bool is_on_side(double x, double midline, Side side);

/// Sets everything beyond the midline to air.
void keep_side(Volume<std::uint8_t>& labels, double midline, Side side);

}  // namespace mammotwin
