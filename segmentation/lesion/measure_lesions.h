#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// Centroid and volume of each lesion label, in label order; ids are "lesion-1" and so on.
std::vector<Lesion> measure_lesions(const Volume<std::uint8_t>& labels);

}  // namespace mammotwin
