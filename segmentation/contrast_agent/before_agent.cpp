#include "segmentation/contrast_agent/before_agent.h"

#include "segmentation/contrast_agent/enhancement.h"
#include "segmentation/image/denoise.h"

namespace mammotwin {

BeforeAgent lay_before_agent(const Volume<float>& pre, const BodyStage& body) {
  BeforeAgent before;
  before.image = on_grid_of(body.image, pre);
  before.enhancement =
      relative_enhancement(body.clean, denoised(before.image, body.noise), body.noise);
  return before;
}

}  // namespace mammotwin
