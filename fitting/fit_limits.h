#pragma once

namespace mammotwin::limits {

/// Beyond these a fit is `look`: what the stage judges by and the report shows beside them.
inline constexpr double skin_rms_mm = 0.5;      ///< mesh to labels and back: 0.45 at worst of 22
inline constexpr double skin_p95_mm = 0.8;      ///< the same, of 95 % of it
inline constexpr double chest_wall_rms_mm = 2;  ///< mesh to the muscle's front
inline constexpr double covered_breast = 0.97;  ///< of the breast's voxels, at least
inline constexpr double covered_lesions = 0.99;

}  // namespace mammotwin::limits
