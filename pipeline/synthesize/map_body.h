#pragma once

#include <cstdint>

#include "pipeline/synthesize/tissue_map.h"
#include "segmentation/label_maps/label_values.h"

namespace mammotwin {

/// A real body from a label map made elsewhere: the map's own breasts, and behind the front of its
/// muscle a thorax that it lacks. On the map's grid, shifted so that the tissue's middle is x = 0.
struct MapBody {
  /// Substance of each voxel; `transition` is half fat, half fibroglandular.
  static constexpr std::uint8_t transition = num_substances;
  Volume<std::uint8_t> substance;
  Volume<std::uint8_t> lesion;  ///< number of the lesion from 1, largest first; 0 for none
  double last_y = 0;            ///< back end of the map's own tissue [mm]

  /// Materials of cubic voxels from `samples`^3 points in each.
  TissueMap sample(double voxel_mm, int samples) const;
};

/// Presses both breasts between two coil plates each: tissue in front of the breastbone's skin that
/// reaches farther across than `share` of the breast's half width is cut off, and 2.5 mm of skin
/// lie along the cut.
void press_between_plates(MapBody& body, double share);

/// Builds it. The front of the muscle is its foremost voxel in each column (pieces of fewer than
/// 2000 voxels are none; gaps up to 25 mm are bridged in a slice); behind it lie muscle of 10 to
/// 25 mm, ribs, lung, heart and liver, drawn by `seed`. Beside the muscle, fat and skin of the
/// map's last row go on to the back. Values as in LabelValues; lesions below 0.1 ml are gland.
MapBody body_of_map(const Volume<std::uint16_t>& map, const LabelValues& values,
                    std::uint64_t seed);

}  // namespace mammotwin
