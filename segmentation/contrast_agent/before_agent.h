#pragma once

#include <cstdint>

#include "segmentation/body/body_stage.h"

namespace mammotwin {

/// What an image before contrast agent says of the one after it, on that one's grid.
struct BeforeAgent {
  Volume<float> image;        ///< empty: there is none
  Volume<float> enhancement;  ///< relative_enhancement

  /// Does the largest connected part of the body that at least doubles, the heart or a vessel, have
  /// 20 ml? Without an agent between the two images nothing does.
  bool shows_uptake(const Volume<std::uint8_t>& body) const;

  bool is_given() const { return !image.values.empty(); }
};

/// Brings the image before contrast agent onto the grid of the outline. Throws std::runtime_error
/// where it covers less than 90 % of that.
BeforeAgent lay_before_agent(const Volume<float>& pre, const BodyStage& body);

}  // namespace mammotwin
