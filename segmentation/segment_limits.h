#pragma once

namespace mammotwin::limits {

/// Beyond these a segmentation is `look`: what the stage judges by and the report shows beside
/// them.
inline constexpr double least_breast_ml = 30, most_breast_ml = 4000;
/// 0.14 to 0.20 on the four simulated images whose walls are over 2.5 mm off in the mean (Exam_10);
/// 0.09 at most on those within 1.5 mm but two (seed 1006 0.12, Exam_11 left 0.10).
inline constexpr double chest_wall_doubt = 0.10;
/// 0.06 to 0.18 on those four, whose walls bright tissue on the muscle drew forward; 0.02 at most
/// on walls within 1 mm; 0.04 and 0.07 on two real ones whose walls look right.
inline constexpr double chest_wall_fat_behind = 0.08;
/// Of the wall in front of a side: where a wall found with the prior and one without differ by over
/// 5 mm.
/// 0.6 on the real wall that the prior mended; where the image had its way 0.11 to 0.17 on four
/// whose walls look right.
inline constexpr double chest_wall_disputed = 0.10, chest_wall_unlike_others = 0.30;
inline constexpr double chest_wall_unsteady = 0.10;
/// Of the wall with 25 mm of breast before it: 0.20 between that wall and the one of the same
/// patient's image without fat suppression, which is right.
inline constexpr double chest_wall_unlike_compared = 0.10;
/// 0.3 on a phantom of 8 % noise that lay still; 0.8, 1.4 and 2.9 where it moved 0.6, 1.2 and 2.4
/// mm.
inline constexpr double pre_shift_mm = 1;
inline constexpr double signal_to_noise = 8;  ///< noise of an eighth of fat: classes overlap
/// Of the tissue in front of the breastbone's skin, outside the breast's region: what a rounded
/// corner costs; beyond the second the result is of another breast.
inline constexpr double pendant_outside = 0.03, pendant_outside_refused = 0.15;
/// Standard deviation of the nipple's place, from what else looks like it.
inline constexpr double nipple_sd_mm = 8;
inline constexpr double volume_ratio = 0.4;  ///< smaller over larger breast, at least

}  // namespace mammotwin::limits
