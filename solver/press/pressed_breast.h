#pragma once

#include <memory>
#include <vector>

#include "solver/breast/breast_model.h"
#include "solver/contact/plate_friction.h"
#include "solver/press/compression_problem.h"

namespace mammotwin {

/// A breast whose skin and cut faces meet plates. Where these stand is `contact->plates`: none yet.
struct PressedBreast : BreastModel {
  std::shared_ptr<PlateContact> contact;
  std::shared_ptr<PlateFriction> friction;  ///< null if there is none
  Faces contact_faces;
};

/// Under the problem's body force. Throws std::invalid_argument as make_breast_model does.
PressedBreast make_pressed_breast(const CompressionProblem& problem, const SolidOptions& solid);

/// The breast about which plates are placed: as imaged where something holds it as far forward.
MeshFile as_positioned(const CompressionProblem& problem);

/// Friction as it held a state that was solved elsewhere; frozen_mm: PlateFriction::freeze; 0: not.
void hold_by_friction(PressedBreast& breast, const std::vector<PlateFriction::Hold>& holds,
                      const State& state, double frozen_mm);

}  // namespace mammotwin
