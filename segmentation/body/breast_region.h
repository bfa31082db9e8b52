#pragma once

#include <cstdint>

#include "segmentation/body/pendant_tissue.h"
#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What labels hold. Where it is not known, two breasts with a valley in the middle third of the
/// width between them are both sides.
enum class LabelsHold { perhaps_both_sides, one_side };

/// A breast's region, and what of the breast it leaves out.
struct FoundRegion {
  BreastRegion region;
  PendantTissue pendant;
  OutsideRegion outside;
  /// [mm²] of columns in which the muscle has to be set back (set_muscle_back) to least_tissue_mm.
  double thin_mm2 = 0;
};

/// The rectangle in the coronal plane that bounds one breast, from labels as in tissue.h, of both
/// breasts or of one half of the body.
///
/// It is bounded
///   medially   by the cleft between the two apices (cleft_between); with one side in the labels,
///              by the end of the labels;
///   laterally  35 mm beyond what hangs (but for 1 % of it), and as below;
///   elsewhere  15 mm beyond the part around the apex where tissue is thicker than 0.35 of the
///              apex column; where more than 3 % of the pendant tissue would be left out so, by
///              the slices of that tissue and the end of the labels;
///   below      nearer than that by the inframammary fold, where the skin comes forward by 3 mm
///              again below it;
/// and is, of all rectangles within these bounds of whose columns every one has 5 mm of tissue (8
/// mm in the lateral edge's), the one with most tissue, that behind the breastbone's skin counting
/// a tenth; then pushed out to hold every lesion of that side. Where that leaves out more than 3 %
/// still, muscle close under the skin beside the breast, where its medial edge slants over the
/// breastbone, counts as 5 mm of tissue, if more of the breast is held so.
///
/// Throws std::runtime_error if that side holds no breast that stands out from the chest.
FoundRegion find_region(const Volume<std::uint8_t>& labels, Side side,
                        LabelsHold hold = LabelsHold::perhaps_both_sides);

/// A region that a person gave, out to whole voxels and no farther than the labels reach. Throws
/// std::runtime_error where it holds no column of them, or that side no breast.
FoundRegion given_region(const Volume<std::uint8_t>& labels, const BreastRegion& region);

/// The same as find_region, the region only.
BreastRegion find_breast_region(const Volume<std::uint8_t>& labels, Side side,
                                LabelsHold hold = LabelsHold::perhaps_both_sides);

}  // namespace mammotwin
