#pragma once

#include <optional>

#include "segmentation/image/volume.h"

namespace mammotwin {

struct DicomSeries;

/// What is seen of a series before it is chosen.
struct SeriesLook {
  double signal_to_noise = 0;  ///< fat below the skin over the noise between neighbours
  double skin_over_fat = 0;    ///< brightness; above 1 where fat is suppressed
};

/// Empty where the image shows no body with fat below its skin.
std::optional<SeriesLook> look_at_series(const Volume<float>& image);

/// Of a series, by its middle; empty, too, where it makes no stack.
std::optional<SeriesLook> look_at_series(const DicomSeries& series);

}  // namespace mammotwin
