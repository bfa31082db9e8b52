#pragma once

#include <optional>
#include <string>

#include "segmentation/chest_wall/compared_wall.h"
#include "segmentation/mri/read_mri.h"
#include "segmentation/segment.h"

namespace mammotwin {

// Both are seen in a mirror where `result.quality` is (`in_mirror`), as `body` then is.

/// The image before contrast agent, if one is named, laid on the one after it; of a dynamic study
/// the phase before the one that was chosen, where that shows uptake.
BeforeAgent read_before_agent(const Mri& mri, const SegmentInput& input, const BodyStage& body,
                              SegmentResult& result);

/// Leaves out a phase that was not named and before which the patient moved.
void use_if_still(const std::optional<PreMatch>& match, bool named, BeforeAgent& before,
                  SegmentQuality& quality);

/// Another image of the study, and where its chest wall lies.
struct OtherImage {
  std::string called;
  ComparedWall wall;
};

/// Nothing where there is no other, or where it shows no wall; that is noted.
std::optional<OtherImage> read_other_image(const Mri& mri, const SegmentInput& input,
                                           const BodyStage& body, const PectoralWall& found,
                                           Side side, double stiffness, SegmentResult& result);

}  // namespace mammotwin
