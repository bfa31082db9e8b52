#pragma once

#include <cstdint>
#include <optional>

#include "segmentation/segmentation.h"

namespace mammotwin {

/// A breast imaged without the other one, or of a woman who has one.
struct LoneBreast {
  Side side = Side::left;
  double breastbone_x = 0;  ///< [mm, LPS]
  bool is_cut = false;      ///< the image ends where the skin still falls towards the breastbone
};

/// Of a body in whose outline no two breasts stand, the one that stands at least 20 mm out from the
/// skin over the breastbone. That is the deepest beside it where the image shows one half of the
/// chest: towards the flank the skin lies at least 10 mm deeper still, or ends, which tells the
/// side. Where it shows the whole chest it is the middle of the skin. Empty where there is none.
std::optional<LoneBreast> find_lone_breast(const Volume<std::uint8_t>& body);

/// The image from the breastbone on and, on the other side of it, its mirror image, so that all
/// that needs two breasts finds them.
template <class T>
Volume<T> with_mirror_image(const Volume<T>& image, const LoneBreast& lone);

}  // namespace mammotwin
