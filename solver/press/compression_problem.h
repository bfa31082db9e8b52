#pragma once

#include <limits>

#include "solver/breast/breast_problem.h"
#include "solver/contact/plate_placement.h"
#include "solver/element/solid_element.h"

namespace mammotwin {

/// With the plates (contact/plate_friction.h).
struct FrictionOptions {
  double coefficient = 0;  ///< in [0, 1]; 0: none
  double slip = 0.1;       ///< a point sticks until it slid so far [mm] > 0
};

/// One breast between two plates. The solver knows nothing of views: the plates say which way.
/// Where gravity or pull is not zero the breast first comes to rest under both, then plates close.
struct CompressionProblem : BreastProblem {
  FrictionOptions friction;
  PlateOptions plates;
  /// What holds the breast drawn onto the support, on the tissue's volume [mN/mm³]. Plates are
  /// placed about the imaged breast.
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  /// Of the paddle [N] > 0: it stops there, before the thickness that the plates say.
  double most_force = std::numeric_limits<double>::infinity();

  Eigen::Vector3d body_force() const { return density * gravity + pull; }  ///< [mN/mm³]
};

enum class Moving {
  both,   ///< plates close on the breast from both sides
  paddle  ///< the support first lifts the breast to its place, then only the paddle moves
};

struct CompressionOptions {
  SolidOptions solid;
  Moving moving = Moving::both;
  double gap_tolerance = 0.2;         ///< ContactFigures::mean_gap [mm] > 0
  double thickness_tolerance = 0.05;  ///< |measured − asked| [mm] > 0
  double first_step = 1;              ///< of the way, in (0, 1]
  double longest_move = 10;           ///< of a plate in one load step [mm] > 0
  double smallest_step = 1.0 / 64;    ///< give up below this part of the way
  int max_iterations = 500;           ///< Newton iterations of the load steps together
  /// Load steps come five times as near to balance, and to one that is stable.
  bool careful = false;
  /// Of the tissue in front of the plates' edges, in [0, 1): where less stays there the breast
  /// counts as slipped out. Real breasts, soft, that a coil pressed flat in the MRI keep 0.3 to 0.5
  /// and rest between the plates.
  double least_retained = 0.2;
  /// Likewise: a breast that comes to no rest between the plates and of which less stays there is
  /// pressed again, drawn harder, as a radiographer takes it out and begins anew.
  double well_retained = 0.6;
  double most_drawn = 4;  ///< times `CompressionProblem::pull`
  /// In `compress_from`: friction's tractions stay those of the result that it starts from, but for
  /// springs of this reach [mm] > 0 (PlateFriction::freeze); 0: they follow Coulomb's law.
  double frozen_friction = 0;
};

}  // namespace mammotwin
