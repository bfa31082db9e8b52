#pragma once

#include "segmentation/body/body_stage.h"
#include "segmentation/chest_wall/settle_wall.h"
#include "segmentation/chest_wall/steady_wall.h"
#include "segmentation/contrast_agent/before_agent.h"
#include "segmentation/contrast_agent/pre_match.h"

namespace mammotwin {

/// The wall, and what it may as well be.
struct FoundWall {
  PectoralWall wall;                   ///< the middle one of three searches
  std::vector<PectoralWall> searches;  ///< all three (steady_wall.h)
  SettledWall first;                   ///< of them
};

/// Image with coarse bias correction, fat at 1, and the chest wall.
struct WallStage {
  Volume<float> corrected;
  Volume<float> wide_log_bias;  ///< the 60 mm part of the bias only: leaves local faults in
  WallContrast contrast;
  FoundWall found;
  std::optional<PreMatch> pre_match;  ///< of the image before contrast agent, in front of the wall
};

/// Finds it in the image, with muscle as bright as the study saw it or, where the image does not
/// support that, as learnt from it (muscle_brightness.h); then again in its mean with the image
/// before contrast agent, if there is one and the patient did not move in between: there the heart
/// is as dark as muscle when fat is not suppressed, and noise is less. The search runs three times,
/// with the usual place of the wall and muscle's brightness moved by as much as nobody knows them
/// better; the middle wall is taken (steady_wall.h). `side`: whose breast is compared for movement.
/// `drawn_in_lps`: points on the wall that a person drew, or none; between them it is held
/// (drawn_wall.h).
WallStage find_wall(const BodyStage& body, const BeforeAgent& before, Side side, double stiffness,
                    const std::vector<Eigen::Vector3d>& drawn_in_lps = {});

}  // namespace mammotwin
