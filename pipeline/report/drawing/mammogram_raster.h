#pragma once

#include <string>

#include "pipeline/report/drawing/section.h"
#include "registration/mammogram/mammogram_image.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// A mammogram as a section over (u, v) of its detector shows it, grey between its 2 % darkest and
/// 0.2 % brightest pixels there; light grey where there is no image.
Raster mammogram_raster(const MammogramImage& image, const Detector& detector,
                        const Section& section, double pixel_mm);

/// The same in the mammogram's own pixels, as JPEG.
std::string native_mammogram(const MammogramImage& image, const Detector& detector,
                             const Section& section);

}  // namespace mammotwin
