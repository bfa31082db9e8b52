#pragma once

#include <filesystem>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Labels of a VICTRE phantom, in a frame of ours: (lateral, up, depth), the file's (y, z, x), so
/// that depth runs from the chest wall to the nipple and plates are normal to `up` [mm].
struct VictreLabels {
  Volume<std::uint8_t> values;
  std::uint8_t at(const Eigen::Vector3d& x) const;  ///< of the nearest voxel; 0 outside
};

/// Reads `<name>.mhd` and `<name>.raw.gz` beside it (the header names the file without .gz).
/// Throws std::runtime_error naming the file where one is missing or shorter than its header says.
VictreLabels read_victre_labels(const std::filesystem::path& folder, const std::string& name);

namespace victre {
bool is_breast(std::uint8_t value);  ///< neither air, muscle nor plate
bool is_gland(std::uint8_t value);   ///< gland, nipple, lobules, ducts
}  // namespace victre

}  // namespace mammotwin
