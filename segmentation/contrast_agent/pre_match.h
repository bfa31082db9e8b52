#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// How an image before contrast agent lies on the one after it.
struct PreMatch {
  double scale = 1;  ///< median of post / pre
  /// Displacement [mm] that nine in ten parts of 24 mm stay below, of those in which the images
  /// show it to a quarter of a millimetre; empty if there are none.
  std::optional<double> shift_mm;

  /// Did the patient move by more than limits::pre_shift_mm?
  bool moved() const;
};

/// Compares them in `where`, part by part: post - scale pre = grad . displacement + change pre by
/// least squares, on images smoothed by a voxel (Lucas and Kanade, IJCAI 1981, 674-679). Measured
/// up to 2.4 mm. `noise`: standard deviation of each voxel of
/// either, 0 where not known.
PreMatch match_pre(const Volume<float>& post, const Volume<float>& pre, const Volume<float>& noise,
                   const Volume<std::uint8_t>& where);

/// The mean of `post` and `scale` times `pre`: fat and gland hardly change with contrast agent, and
/// half of the noise's square is gone.
Volume<float> mean_with_pre(Volume<float> post, const Volume<float>& pre, double scale);

}  // namespace mammotwin
