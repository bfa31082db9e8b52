#pragma once

#include <string>

#include "fitting/surface/triangle_surface.h"
#include "fitting/surface/wall_height.h"

namespace mammotwin {

/// The skin that a slab is fitted to: smoothed (Gaussian of 1 mm), on a grid of 2 mm.
struct SkinToFit {
  TriangleSurface surface;
  BreastRegion region;  ///< smaller than the segmentation's where its edge had to be left out
  std::string doubt;    ///< a sentence that says so; empty otherwise
};

/// Closes the body as little as makes its skin a disc with four corners. Where that does not help
/// (ragged labels at the end of the field of view), edges of the region are pulled in by up to
/// 21 mm, as few and as little as will do, but never past a lesion. An edge whose plane the skin
/// grazes, at less than some 15 degrees on the whole, is pulled in by up to 6 mm: elements there
/// would have to be as flat. Throws std::runtime_error if nothing helps.
SkinToFit find_skin_to_fit(const Segmentation& segmentation, const MuscleFront& wall);

/// The same skin with the region's edges within 40 mm of a place pulled in by `by` [mm], never
/// past a lesion; without triangles where no edge is near or that leaves no disc.
SkinToFit without_edges_near(const Eigen::Vector3d& place, double by, const SkinToFit& skin,
                             const std::vector<Lesion>& lesions);

/// A scanned skin inside the region. Throws std::runtime_error if that is no disc with four
/// corners.
SkinToFit scanned_skin_to_fit(const TriangleSurface& scan, const BreastRegion& region);

/// The skin as labelled: neither closed nor smoothed.
TriangleSurface skin_as_labelled(const Segmentation& segmentation, const BreastRegion& region,
                                 const MuscleFront& wall);

}  // namespace mammotwin
