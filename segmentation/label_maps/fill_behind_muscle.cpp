#include "segmentation/label_maps/fill_behind_muscle.h"

#include "segmentation/body/breast_region.h"
#include "segmentation/image/components.h"

namespace mammotwin {

void fill_behind_muscle(Volume<std::uint8_t>& labels) {
  auto muscle = labels.like<std::uint8_t>(0);
  for (std::size_t v = 0; v < labels.values.size(); ++v)
    muscle.values[v] = labels.values[v] == label::muscle;
  const auto front = without_small_components(muscle, least_muscle_ml);
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      bool behind = false;
      for (int j = 0; j < labels.size.y(); ++j) {
        std::uint8_t& value = labels(i, j, k);
        behind = behind || front(i, j, k);
        if (behind && !label::is_lesion(value)) value = label::muscle;
        if (!behind && value == label::muscle) value = label::fat;
      }
    }
}

}  // namespace mammotwin
