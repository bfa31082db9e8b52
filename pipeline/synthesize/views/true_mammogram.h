#pragma once

#include "pipeline/synthesize/views/true_views.h"
#include "registration/export/png_file.h"

namespace mammotwin {

/// Detector of every synthetic mammogram: 240 x 300 mm in pixels of 0.25 mm, chest wall as hung.
Detector synthetic_detector(Side side);

/// (depth, lateral, height) of a point of the prone breast in the true view [mm].
Eigen::Vector3d true_place(const TrueBreast& breast, const TrueView& view,
                           const Eigen::Vector3d& prone_in_lps);

/// (column, row) of a point of the prone breast in the true view.
Eigen::Vector2d true_mark(const TrueBreast& breast, const TrueView& view, const Detector& detector,
                          const Eigen::Vector3d& prone_in_lps);

/// The view as an X-ray image: Beer-Lambert through the true tissue, quantum noise, a metal marker
/// of 3.5 mm on the nipple; dense tissue is bright; what lies behind (picture_behind.h). No
/// scatter.
GreyPixels true_mammogram(const TrueBreast& breast, const TrueView& view, const Detector& detector,
                          std::uint64_t seed);

}  // namespace mammotwin
