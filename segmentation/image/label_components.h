#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace mammotwin {

/// Number of the connected part (neighbours across faces) of each voxel of a mask, from 1 in the
/// order of their first voxels; 0 outside. By ITK, hence in plain arrays; first axis fastest.
std::vector<std::int32_t> label_components(const std::array<int, 3>& size,
                                           const std::vector<std::uint8_t>& mask);

}  // namespace mammotwin
