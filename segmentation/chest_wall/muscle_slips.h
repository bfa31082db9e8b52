#pragma once

#include <vector>

#include "segmentation/chest_wall/half_breast.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// What passes for gland and may be muscle in front of the wall found: the free edge of the
/// pectoral muscle in the axilla, a slip on the flank. One radius for each ray finds the deeper of
/// two muscles with fat between them.
struct MuscleSlip {
  double ml = 0;
  double forward_mm = 0;  ///< how far in front of the wall nine tenths of it end
  Eigen::Vector3d middle_in_lps = Eigen::Vector3d::Zero();
};

/// Pieces of gland (`gland_fraction` over a half) with a core thicker than vessels that begins at
/// the wall and is as bright as what lies behind it, which end within 15 mm of it. Gland that lies
/// on the muscle can look so, too. `image`: bias corrected, fat at 1.
std::vector<MuscleSlip> find_muscle_slips(const HalfBreast& half,
                                          const Volume<float>& gland_fraction,
                                          const Volume<float>& image);

/// Doubts the wall behind those of 3 to 12 ml in the region; more is a layer of gland.
void judge_muscle_slips(const std::vector<MuscleSlip>& slips, const BreastRegion& region,
                        SegmentQuality& quality);

}  // namespace mammotwin
