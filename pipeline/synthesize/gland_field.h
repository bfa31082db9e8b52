#pragma once

#include <Eigen/Core>

#include "pipeline/synthesize/duct_tree.h"

namespace mammotwin {

/// Where a breast is fibroglandular: a field on a 1 mm grid over the breast, interpolated
/// linearly, that is negative in the tissue. It is the distance to the ducts roughened by noise,
/// less the thickness of tissue round them that gives the density asked for.
class GlandField {
 public:
  /// `volume_mm3`: fibroglandular tissue wanted.
  GlandField(const Chest& chest, Side side, std::uint64_t seed, double volume_mm3,
             double fat_margin_mm);

  double operator()(const Eigen::Vector3d& x) const;  ///< +1 outside the grid

 private:
  Volume<float> field_;
};

}  // namespace mammotwin
