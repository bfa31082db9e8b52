#include "segmentation/shading/half_images.h"

namespace mammotwin {

HalfImages cut_images(const BodyStage& body, const BeforeAgent& before, const WallStage& wall,
                      const VoxelBox& box) {
  HalfImages images;
  images.noisy = cropped(wall.corrected, box);
  images.denoised = images.noisy;
  images.noise = images.noisy.like<float>(0);
  if (before.is_given()) {
    images.pre = cropped(before.image, box);
    images.enhancement = cropped(before.enhancement, box);
  }
  const Volume<float> uncorrected = cropped(body.image, box), clean = cropped(body.clean, box);
  for (std::size_t v = 0; v < uncorrected.values.size(); ++v) {
    if (!(uncorrected.values[v] > 0)) continue;
    const float gain = images.noisy.values[v] / uncorrected.values[v];
    if (before.is_given()) images.pre.values[v] *= gain;
    images.denoised.values[v] = clean.values[v] * gain;
    images.noise.values[v] = static_cast<float>(body.noise) * gain;
  }
  return images;
}

}  // namespace mammotwin
