#pragma once

#include "segmentation/image/volume.h"

namespace mammotwin {

/// Left and right exchanged on the same grid.
template <class T>
Volume<T> flipped(const Volume<T>& image) {
  Volume<T> result = image;
  for (int k = 0; k < image.size.z(); ++k)
    for (int j = 0; j < image.size.y(); ++j)
      for (int i = 0; i < image.size.x(); ++i)
        result(i, j, k) = image(image.size.x() - 1 - i, j, k);
  return result;
}

}  // namespace mammotwin
