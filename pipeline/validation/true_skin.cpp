#include "pipeline/validation/true_skin.h"

#include "pipeline/synthesize/gel_breast.h"

namespace mammotwin {

ScannedSkin true_skin(const ScannedBreast& breast, double step_mm) {
  ScannedSkin skin{gel_breast_surface(step_mm), 0};
  for (auto& x : skin.surface.vertices) x = breast.frame_from_file * x;
  return skin;
}

}  // namespace mammotwin
