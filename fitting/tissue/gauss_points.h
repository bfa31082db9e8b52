#pragma once

#include <array>

namespace mammotwin {

/// Gauss-Legendre on [0,1]: exact for polynomials up to degree 7.
constexpr std::array<double, 4> gauss_points = {0.06943184420297371, 0.33000947820757187,
                                                0.66999052179242813, 0.93056815579702629};
constexpr std::array<double, 4> gauss_weights = {0.17392742256872693, 0.32607257743127307,
                                                 0.32607257743127307, 0.17392742256872693};

}  // namespace mammotwin
