#pragma once

namespace mammotwin::limits {

/// Beyond these a segmentation is `look`: what the stage judges by and the report shows beside them.
inline constexpr double least_breast_ml = 30, most_breast_ml = 4000;
/// 0.112 to 0.155 on the three images simulated from label maps whose walls are 3 mm and more off
/// in the mean (Exam_10), 0.096 at most on 36 others but one (Exam_02 left, 0.119, lesion on it).
inline constexpr double chest_wall_doubt = 0.10;
/// 0.10 to 0.17 where bright tissue on the muscle drew the wall 1.6 to 4.7 mm forward (Exam_10,
/// seed 1017 after contrast agent); 0.003 on three simulated images with sound walls, 0.04 and 0.07
/// on two real ones whose walls look right.
inline constexpr double chest_wall_fat_behind = 0.08;
inline constexpr double signal_to_noise = 8;  ///< noise of an eighth of fat: classes overlap
inline constexpr double volume_ratio = 0.4;   ///< smaller over larger breast, at least

}  // namespace mammotwin::limits
