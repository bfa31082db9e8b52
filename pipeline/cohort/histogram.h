#pragma once

#include <string>

#include "pipeline/cohort/distribution.h"

namespace mammotwin {

/// An inline SVG of a distribution that is not constant: bars, a band from first to third quartile
/// with the median, and a diamond for each outlier. Says in words what it shows (role="img").
std::string histogram_svg(const Distribution& distribution);

/// "mm" for a name that ends in _mm; empty where the name says no unit.
std::string unit_of(const std::string& figure_name);

}  // namespace mammotwin
