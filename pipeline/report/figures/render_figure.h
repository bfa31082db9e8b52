#pragma once

#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// What a still picture of the breast shows.
struct BreastShape {
  std::string name, caption;
  const HermiteMesh* mesh;
  const ViewResult* view = nullptr;  ///< whose plates are drawn, too
};

/// Prone, unloaded and compressed, as far as they exist. They refer to `results`.
std::vector<BreastShape> breast_shapes(const PatientResults& results);

/// A shape seen obliquely from the front, shaded, with the lesions showing through the skin.
Figure render_figure(const PatientResults& results, const BreastShape& shape);

}  // namespace mammotwin
