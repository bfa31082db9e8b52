#pragma once

#include <vector>

namespace mammotwin {

/// Brightness by signed depth below the skin's surface (negative: in air), air's noise at 0.
struct SkinProfile {
  std::vector<double> depth, value;  ///< [mm], fat about 1
};

/// Air, skin and fat behind one another, as a blurred image shows them: with N the normal
/// distribution of the image's blur, o = N(d - surface) and i = N(d - surface - thickness),
/// value(d) = skin (o - i) + i (fat + slope max(0, d - surface - thickness)).
/// The slope (of shading, and of gland that comes with depth) is held near 0.
struct SkinSlab {
  double thickness = 0;      ///< [mm]; 0: the profile is too short
  double low = 0, high = 0;  ///< range of the thickness [mm]
  double surface = 0;        ///< depth at which the skin begins [mm]
  double misfit = 0;         ///< root mean square of the best fit over fat
  bool over_fat = true;      ///< false: gland lies under nearly all of it, and may pass for it
};

/// Thickest slab tried [mm]: fat must show below it in the 5.5 mm that are looked at.
inline constexpr double thickest_measured_skin_mm = 5;
inline constexpr double thinnest_measured_skin_mm = 0.3;

/// Of skin: 1.5 mm within a factor of 1.65 (standard deviation; Huang et al., Med. Phys. 35 (2008),
/// 1199-1206, measured 1.45 mm, 0.8 to 2.4).
inline constexpr double usual_skin_mm = 1.5, usual_skin_factor = 1.65;
/// Of fat over a millimetre (standard deviation); else a slope could stand for half the skin.
inline constexpr double usual_fat_slope = 0.05;
/// Errors of a profile hang together over about 1 mm, so that its 8 mm are worth this many values.
inline constexpr double independent_profile_values = 8;

/// Fits it with the blur as an unknown between 0.4 and 0.9 voxels, all the same to begin with. The
/// range are the thicknesses with which some blur, surface and levels fit nearly as well as the
/// best: bright thin skin trades thickness for brightness and blur, and its range says so. The
/// thickness is the mean, weighted by the fit and by what is usual, which matters only where the
/// image does not tell.
SkinSlab fit_skin_slab(const SkinProfile& profile, double voxel_mm);

}  // namespace mammotwin
