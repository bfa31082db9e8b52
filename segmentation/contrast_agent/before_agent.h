#pragma once

#include "segmentation/body/body_stage.h"

namespace mammotwin {

/// What an image before contrast agent says of the one after it, on that one's grid.
struct BeforeAgent {
  Volume<float> image;        ///< empty: there is none
  Volume<float> enhancement;  ///< relative_enhancement

  bool is_given() const { return !image.values.empty(); }
};

/// Brings the image before contrast agent onto the grid of the outline. Throws std::runtime_error
/// where it covers less than 90 % of that.
BeforeAgent lay_before_agent(const Volume<float>& pre, const BodyStage& body);

}  // namespace mammotwin
