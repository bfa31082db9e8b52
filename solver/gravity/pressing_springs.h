#pragma once

#include <vector>

#include "solver/breast/breast_problem.h"
#include "solver/element/face.h"

namespace mammotwin {

/// What pressed the imaged skin, as springs between where that skin comes to lie free of load and
/// where it is thought to: at a point x of the imaged skin whose place free of load is X, with the
/// outward direction n, share and way of PressedSkin,
///
///     pressure = k share (way way_mm − n · (X − x))   along −n
///
/// Stiff springs (k ≫ modulus / size) give the shape and ask no more of the pressure than that it
/// makes it so: soft tissue moves by centimetres for a pressure that nobody could guess to a
/// tenth. Nothing is said along the skin.
class PressingSprings {
 public:
  /// Of problem.pressed on problem.mesh, the imaged shape; k [kPa/mm].
  PressingSprings(const BreastProblem& problem, double k);

  bool any() const { return !faces_.empty(); }

  /// Adds the pressure's residual in element e, and its derivative by X, to the systems; either may
  /// be null. X: the element's place free of load.
  void add(int e, const SolidElement::Coefficients& X, double way_mm, ElementSystem* forward,
           ReferenceSystem* reference) const;

  /// The same as forces, for each element.
  DeadForces forces(const HermiteMesh& unloaded, double way_mm) const;

  /// Of the outward directions' two sides, what presses on each, in the mean [N].
  double force_N(const HermiteMesh& unloaded, double way_mm) const;

 private:
  std::vector<Face> faces_;                 ///< of the imaged shape, with pressed points
  std::vector<std::vector<int>> faces_of_;  ///< by element: indices of faces_
  std::vector<PressedSkin::Point> points_;  ///< by surface point
  double k_;
};

}  // namespace mammotwin
