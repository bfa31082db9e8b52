#pragma once

#include <vector>

namespace mammotwin {

/// Of sorted values, at least one: the middle one, or the mean of the middle two.
double median_of_sorted(const std::vector<double>& sorted);

/// The value nearest to the place `share` (0 to 1) of the sorted values, of which there is at least
/// one.
double quantile_of(std::vector<double> values, double share);

}  // namespace mammotwin
