#pragma once

#include <utility>
#include <vector>

#include "registration/prediction/project_lesions.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Pieces of a line on the detector (u, v) [mm].
using DetectorPieces = std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>;

/// The shadow's edge of a lesion: its voxels (label `value`), each a ball of the voxel's volume,
/// carried into the compressed breast and along the rays; gaps of up to two voxels are closed.
/// Empty where no voxel has that label.
DetectorPieces lesion_outline(const Volume<std::uint8_t>& labels, std::uint8_t value,
                              const ViewProjection& projection);

}  // namespace mammotwin
