#include "segmentation/contrast_agent/before_agent.h"

#include "segmentation/contrast_agent/enhancement.h"
#include "segmentation/image/components.h"
#include "segmentation/image/denoise.h"

namespace mammotwin {

bool BeforeAgent::shows_uptake(const Volume<std::uint8_t>& body) const {
  constexpr float doubles = 1;
  constexpr double least_ml = 20;
  auto taken_up = body;
  for (std::size_t v = 0; v < body.values.size(); ++v)
    taken_up.values[v] = body.values[v] && enhancement.values[v] >= doubles;
  double voxels = 0;
  for (const std::uint8_t value : largest_component(taken_up).values) voxels += value;
  return voxels * body.voxel_volume() >= least_ml * 1000;
}

BeforeAgent lay_before_agent(const Volume<float>& pre, const BodyStage& body) {
  BeforeAgent before;
  before.image = on_grid_of(body.image, pre);
  before.enhancement =
      relative_enhancement(body.clean, denoised(before.image, body.noise), body.noise);
  return before;
}

}  // namespace mammotwin
