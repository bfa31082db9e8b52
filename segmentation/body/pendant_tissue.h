#pragma once

#include <optional>

#include "segmentation/body/tissue_columns.h"

namespace mammotwin {

/// The breast as what hangs, whatever its region: tissue of one side in front of the skin over the
/// breastbone, in the slices between the fold below and the one above.
struct PendantTissue {
  double sternal_y = 0;          ///< skin between the breasts [mm, LPS]
  double z_low = 0, z_high = 0;  ///< [mm, LPS]
  double medial_x = 0;           ///< where the side begins [mm, LPS]
  Side side = Side::left;

  bool contains(const Eigen::Vector3d& x_in_lps) const;
};

/// From labels, whose side begins at the column `medial`, and the column with the apex. The skin
/// over the breastbone is that of the 10 mm next to the medial column, at its most anterior within
/// 10 mm of the apex's height; the slices are those around the apex in which some column stands
/// out from it by a quarter of the apex's height, and 12 mm at least.
PendantTissue find_pendant_tissue(const Volume<std::uint8_t>& labels, const TissueColumns& columns,
                                  const ColumnBox& half, int apex_i, int apex_k, Side side);

/// Its largest connected part (ghosts beside the body are others) as a mask on the labels' grid.
Volume<std::uint8_t> hanging_tissue(const PendantTissue& pendant,
                                    const Volume<std::uint8_t>& labels);

/// How far it reaches laterally: beyond that x [mm, LPS] lies this share of its volume.
double lateral_reach(const PendantTissue& pendant, const Volume<std::uint8_t>& hanging,
                     double share);

/// What of it lies outside a region.
struct OutsideRegion {
  double share = 0;  ///< of its volume
  double volume_ml = 0;
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();  ///< of what is outside [mm]
};
OutsideRegion outside_region(const Volume<std::uint8_t>& hanging, const BreastRegion& region);

}  // namespace mammotwin
