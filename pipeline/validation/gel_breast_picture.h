#pragma once

#include "pipeline/report/drawing/picture.h"
#include "pipeline/validation/gel_breast_case.h"

namespace mammotwin {

/// Each state from beside the patient: the model's element lines on the near side of the skin, and
/// every fourth point of the true skin's scan, as the paper draws mesh and scan (its figure iv).
Picture gel_breast_picture(const GelBreastResult& result);

}  // namespace mammotwin
