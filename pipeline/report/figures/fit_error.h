#pragma once

#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/figure.h"
#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Distance at which the colours of the fit's error end [mm].
inline constexpr double kFitErrorEnd_mm = 1;

/// White where mesh and image agree, blue to red where the mesh's skin lies inside or outside by
/// `kFitErrorEnd_mm` or more.
Colour fit_error_colour(double mm);

/// Signed distance of the mesh's skin to the image's, positive outside [mm], at the points that
/// `triangulate(results.prone->mesh, faces, samples)` makes; empty where the fit left none.
std::vector<double> fit_errors(const PatientResults& results, const std::vector<ElementFace>& faces,
                               int samples);

/// The prone breast from two sides with the fit's error painted on its skin.
std::optional<Figure> fit_figure(const PatientResults& results);

}  // namespace mammotwin
