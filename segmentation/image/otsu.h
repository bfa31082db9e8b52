#pragma once

#include <vector>

namespace mammotwin {

/// Otsu's threshold between the dark and the bright of some values, in 256 bins from 0 to `high`;
/// what is above counts as `high`. By ITK. 0 of no values.
double otsu_threshold(const std::vector<float>& values, double high);

}  // namespace mammotwin
