#include "segmentation/mirrored.h"

namespace mammotwin {

BreastRegion mirrored(const BreastRegion& region) {
  return {mirrored(region.side), -region.x_max, -region.x_min, region.z_min, region.z_max};
}

Segmentation mirrored(const Segmentation& s) {
  Segmentation result{mirrored(s.labels), mirrored(s.fractions), mirrored(s.region), s.lesions,
                      mirrored(s.nipple_in_lps)};
  for (Lesion& lesion : result.lesions) lesion.centroid_in_lps = mirrored(lesion.centroid_in_lps);
  return result;
}

}  // namespace mammotwin
