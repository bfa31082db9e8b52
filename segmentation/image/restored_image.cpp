#include "segmentation/image/restored_image.h"

#include "segmentation/image/total_variation.h"

namespace mammotwin {

Volume<float> restored_image(const Volume<float>& image, const Volume<float>& noise) {
  constexpr double strength = 0.3, blur_voxels = 0.55;
  return total_variation_restored(image, noise, strength, blur_voxels);
}

}  // namespace mammotwin
