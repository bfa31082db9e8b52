#include "segmentation/image/restored_scan.h"

#include "segmentation/image/total_variation.h"

namespace mammotwin {

Volume<float> restored_scan(const Volume<float>& scan, const Volume<float>& noise) {
  constexpr double strength = 0.3, blur_voxels = 0.55;
  return total_variation_restored(scan, noise, strength, blur_voxels);
}

}  // namespace mammotwin
