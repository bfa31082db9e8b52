#pragma once

#include <nlohmann/json_fwd.hpp>

#include "segmentation/skin/skin_slab.h"

namespace mammotwin {

/// Skin as skin_slab.h describes it, in units of `profile` there.
struct DrawnSkin {
  double thickness = 1.5, surface = 0;  ///< [mm]
  double blur = 0.65;                   ///< [voxels]
  double level = 2, fat = 1, slope = 0;
};

/// Its profile every quarter of a millimetre from -3 to 5.5.
SkinProfile profile_of(const DrawnSkin& skin, double voxel_mm);

/// The same six numbers from a profile by Ceres, bounded as fit_skin_slab bounds them, from thin,
/// usual and thick skin on, bright and dark; the best end counts. `noise` is the standard deviation
/// of the values over fat. `usual`: with fit_skin_slab's distribution of thicknesses, so the most
/// probable skin, else the one that fits best.
DrawnSkin skin_by_ceres(const SkinProfile& profile, double voxel_mm, double noise, bool usual);

/// Drawn skins, bright and dark, with little and with much noise: how far off fit_skin_slab is and
/// how far Ceres. `cases` of a table for docs/measured.
nlohmann::json skin_slab_fits();

}  // namespace mammotwin
