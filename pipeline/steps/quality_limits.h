#pragma once

namespace mammotwin::limits {

/// Beyond these a stage's result is `look`: what stages judge by and the report shows beside them.
/// A matter of trust and not of arithmetic: the lesion error that people accept is millimetres, and
/// tissue keeps its volume.
inline constexpr double thickness_error_mm = 0.1;  ///< compressed thickness off the one asked for
inline constexpr double volume_change = 0.01;      ///< share, either way
inline constexpr double mean_gap_mm = 0.25;        ///< to the plates, weighed by their pressure
inline constexpr double penetration_mm = 0.55;     ///< of a plate, at most anywhere
inline constexpr double imbalance_percent = 0.1;   ///< of forces: it moves tissue by some 0.1 mm
inline constexpr double share_of_sane_J = 0.99;    ///< of points, at least, with J within half of 1
/// Of the paddle: Norway's screening presses with 116 N in the mean and recommends 177 at most.
inline constexpr double force_N = 200;
/// Mammograms show the nipple at the front and the breast spread, not rolled over.
inline constexpr double swing_mm = 20;  ///< of the nipple along the plates' edges, either way
inline constexpr double roll_deg = 20;  ///< of the tissue between the plates
/// Of the tissue in front of the plates' edges, at least: ten breasts of label maps keep 0.9, two
/// real ones 0.7 to 0.9 in both views.
inline constexpr double retained_fraction = 0.6;
/// Hanging. With tissue that goes as far as women's from prone to supine, ten breasts have 1.35
/// to 1.7.
inline constexpr double stretch_p95 = 1.75;
inline constexpr double round_trip_mm = 5;  ///< of a node that is unloaded and loaded again
inline constexpr double stiffened = 1.25;   ///< of the tissue as set, so that the breast hangs
/// From where a breast was imaged to another pose. Of 64 women's nipples 95 % go less than 172 mm.
inline constexpr double pose_move_mm = 200;

}  // namespace mammotwin::limits
