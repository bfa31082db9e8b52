#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace mammotwin {

/// How much each voxel of `where` lies on a bright tube as wide as a Gaussian of standard deviation
/// `sigma_mm`: with the eigenvalues a <= b <= c of sigma^2 times the Hessian of the image smoothed
/// so, c's magnitude less than b's and b at least 0.4 of a, it is -b - max(-c, 0), in the image's
/// units; else, and elsewhere, 0. On the axis of a tube whose section is that Gaussian it is a
/// quarter of the tube's height over what lies round it; on a sheet or a ball it is 0 (after Sato
/// 1998; a tube is long, so c is about 0). By ITK, hence in plain arrays; first axis fastest.
std::vector<float> tube_response(const std::array<int, 3>& size,
                                 const std::array<double, 3>& spacing_mm,
                                 const std::vector<float>& image,
                                 const std::vector<std::uint8_t>& where, double sigma_mm);

}  // namespace mammotwin
