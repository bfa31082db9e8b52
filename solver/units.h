#pragma once

namespace mammotwin {

/// The solver works in mm, kPa and so mN; people read newtons.
inline constexpr double kNewtonPerMilli = 1e-3;

}  // namespace mammotwin
