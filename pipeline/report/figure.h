#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/report/drawing/section.h"

namespace mammotwin {

/// What can be shown or not over a picture of the same size: "lesions", "ellipses", ...
struct Layer {
  std::string name;
  Picture picture;
};

/// A picture with the words that stand for it where it cannot be seen.
struct Figure {
  Picture picture;
  std::string caption;
  std::string alt;
  std::vector<Layer> layers = {};  ///< from below
  std::string native = {};  ///< JPEG of the same window in a mammogram's own pixels; or empty
  std::optional<Section> section = {};  ///< of a detector's plane: how (u, v, 0) lies on it

  /// All in one.
  Picture whole() const {
    Picture all(picture.width(), picture.height());
    all.place(picture, 0, 0);
    for (const Layer& layer : layers) all.place(layer.picture, 0, 0);
    return all;
  }
};

}  // namespace mammotwin
