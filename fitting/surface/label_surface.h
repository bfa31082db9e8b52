#pragma once

#include "fitting/surface/triangle_surface.h"
#include "fitting/surface/wall_height.h"

namespace mammotwin {

/// What is cut out of the labels: everything but the air that reaches the front, so that
/// overhanging skin is kept; behind the chest wall all is solid. 1 solid, 0 air. The window holds
/// the region and a margin; where the labels end there, the outermost column goes on. Columns
/// without any label are solid from 5 mm in front of the wall.
struct LabelSurfaceOptions {
  int closing_voxels = 0;  ///< radius of the ball that closes gaps in the body first
  double margin_mm = 8;
};
Volume<float> solid_from_labels(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                                const HeightField& wall, const LabelSurfaceOptions& options);

/// Gaussian of standard deviation sigma_mm.
Volume<float> smoothed(const Volume<float>& volume, double sigma_mm);

/// The same field on a grid of the given spacing in the middle of the volume, trilinear.
Volume<float> resampled(const Volume<float>& volume, double spacing_mm);

/// Where the solid ends: marching cubes at 1/2.
TriangleSurface solid_boundary(const Volume<float>& solid);

/// The largest part of a surface inside the region's planes; vertices within `snap` [mm] of a
/// plane are moved onto it.
TriangleSurface cropped(const TriangleSurface& surface, const BreastRegion& region, double snap);

}  // namespace mammotwin
