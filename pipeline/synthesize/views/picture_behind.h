#pragma once

#include <optional>

#include "registration/prediction/simulated_mammogram.h"

namespace mammotwin {

/// Front edge of the muscle on a detector [mm, u and v], straight.
struct MuscleEdge {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Vector2d towards_skin = Eigen::Vector2d::UnitX();  ///< squarely, of length 1
};

/// -ln(I/I0) of a picture that goes on where the model's breast ends, as that of a woman does.
/// Along each row the breast stays as thick towards the detector's edge as it is in front, and
/// never thicker than the plates are apart; what its rear lacks has the tissue before it. With
/// `muscle` (an oblique view), soft tissue lies over what is behind that edge, and rows between the
/// breast and the image's top go on, towards the armpit, as the topmost row in which the breast is
/// about as thick as the plates are apart; where the edge would leave no tissue before it at the
/// top, it is turned about the place where it meets the detector's. `plates_mm`: apart; `top_v_mm`:
/// of the image's top on the detector.
DetectorImage picture_behind(const SimulatedView& simulated, double plates_mm,
                             const std::optional<MuscleEdge>& muscle, double top_v_mm,
                             const Attenuation& attenuation = {});

}  // namespace mammotwin
