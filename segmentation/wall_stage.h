#pragma once

#include "segmentation/body_stage.h"
#include "segmentation/pectoral_wall.h"

namespace mammotwin {

/// Image with coarse bias correction, fat at 1, and the chest wall found in it.
struct WallStage {
  Volume<float> corrected;
  Volume<float> wide_log_bias;  ///< the 60 mm part of the bias only: leaves local faults in
  WallContrast contrast;
  PectoralWall wall;
};

WallStage find_wall(const BodyStage& body, double stiffness);

}  // namespace mammotwin
