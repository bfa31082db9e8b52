#pragma once

#include "pipeline/frame/outcome.h"
#include "registration/view/plate_escape.h"
#include "solver/press/compression_result.h"

namespace mammotwin {

/// The outcome of a compression: its quality figures (design, section 1) and whether they hold.
/// `escape`: of a usable one. `assumed_thickness`: nobody said how thick the compressed breast was.
Outcome judge_compression(const CompressionReport& report, const PlateEscape& escape,
                          double angle_deg, bool assumed_thickness);

}  // namespace mammotwin
