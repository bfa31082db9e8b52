#pragma once

#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Labels everything behind the front of the muscle as muscle, column by column; lesions stay.
/// Pieces of muscle of less than `least_muscle_ml` have no front; they become fat.
void fill_behind_muscle(Volume<std::uint8_t>& labels);

}  // namespace mammotwin
