#pragma once

#include <vector>

#include "segmentation/chest_wall/polar_rays.h"

namespace mammotwin {

/// Where the front of the chest wall usually lies on a ray of PectoralWall's grid.
struct UsualRadius {
  double mean = 0;    ///< [mm]
  double spread = 0;  ///< standard deviation between patients [mm]; 0: nothing is known there
  /// Weighs at most as much: as much as the image says at most where it shows an edge, and more
  /// than that of an edge of liver or heart, three standard deviations too deep.
  double most = 3;

  /// How unusual a radius is, in standard deviations; negative: deeper. 0 where nothing is known.
  double deviation(double radius_mm) const { return spread > 0 ? (radius_mm - mean) / spread : 0; }
};

/// Of the ten patients of Pelicano et al., PLoS ONE 19 (2024) e0302974, both sides taken together:
/// the outermost muscle in their label maps (prone, 3 T). `angle` from straight ahead [radians],
/// `above_apices` the height over the mean of both apices [mm]; beyond the table's heights the last
/// row holds, beyond 60 degrees (most maps end there) nothing is known. Over the breastbone the
/// maps have muscle behind it and MRI shows its front, so the spread is wider there.
UsualRadius usual_radius(double angle, double above_apices);

/// That of each ray of a wall's grid.
std::vector<UsualRadius> usual_radii(const PectoralWall& grid, const BreastFrame& frame);

/// Adds to the cost of each sample half the squared deviation, up to `most`.
void add_prior(const std::vector<UsualRadius>& usual, std::vector<float>& costs);

}  // namespace mammotwin
