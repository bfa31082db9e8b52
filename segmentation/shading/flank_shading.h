#pragma once

#include "segmentation/body/breast_frame.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// By how much the fat of the flanks is darker than it should be, at each point: 1 up to 20 mm
/// behind the skin between the breasts, what the image shows from 40 mm on, 0.2 at least. There the
/// coil's field falls so steeply, with little fat beside much muscle and lung, that em_bias.h takes
/// fat for muscle; but what lies 4 to 7 mm below that skin is fat.
///
/// `image`: bias corrected, fat at 1. `depth`: below the skin [mm].
Volume<float> flank_shading(const Volume<float>& image, const Volume<float>& depth,
                            const BreastFrame& frame);

}  // namespace mammotwin
