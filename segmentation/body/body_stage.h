#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/body/breast_frame.h"
#include "segmentation/body/contrast.h"
#include "segmentation/body/lone_breast.h"
#include "segmentation/image/volume.h"
#include "segmentation/segment_quality.h"

namespace mammotwin {

/// The outline of the patient and what it tells, on the part of the image around the breasts.
struct BodyStage {
  Volume<float> image;  ///< cropped in front of the breasts and far behind the chest
  Volume<float> clean;  ///< the same, denoised
  Volume<std::uint8_t> body;
  Volume<float> depth;  ///< below the skin [mm]
  double noise = 0;     ///< standard deviation between voxels beside each other [image units]
  double noise_at_distance = 0;  ///< between voxels whose noise is not correlated; no less
  BreastFrame frame;
  Contrast contrast;
  std::optional<LoneBreast> lone;  ///< the other half is its mirror image

  /// By how much the noise of voxels apart exceeds that of neighbours; 1 or more.
  double noise_spread() const { return noise > 0 ? noise_at_distance / noise : 1; }
};

/// Finds them; of a breast imaged alone in the image and its mirror image. Throws
/// std::runtime_error, without the file's name, if the image holds no breast or only a part of one;
/// doubts go to `quality`.
BodyStage find_body(const Volume<float>& image, std::optional<bool> fat_suppressed,
                    SegmentQuality& quality);

}  // namespace mammotwin
