#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "solver/contact/plate_friction.h"
#include "solver/load/wall_surface.h"
#include "solver/newton/dof_map.h"
#include "solver/press/compress.h"

namespace mammotwin {

/// A compression problem turned into energies and equations.
struct BreastModel {
  std::unique_ptr<Model> model;
  std::unique_ptr<DofMap> dofs;
  std::shared_ptr<PlateContact> contact;
  std::shared_ptr<PlateFriction> friction;  ///< null if there is none
  std::shared_ptr<WallSurface> wall;        ///< null if the chest wall is clamped
  std::vector<std::pair<int, int>> contact_faces, wall_faces;  ///< (element, face)
  double largest_modulus = 0;  ///< of the tissue at the quadrature points [kPa]
  double element_size = 0;     ///< cube root of the mean element volume [mm]

  /// Shear modulus / element size [kPa/mm]: the unit of penalties.
  double penalty_unit() const { return largest_modulus / element_size; }
};

/// Throws std::invalid_argument that names what is wrong with the problem.
BreastModel make_breast_model(const CompressionProblem& problem, const SolidOptions& solid);

/// Friction as it held a state that was solved elsewhere; frozen_mm: PlateFriction::freeze; 0: not.
void hold_by_friction(BreastModel& breast, const std::vector<PlateFriction::Hold>& holds,
                      const State& state, double frozen_mm);

}  // namespace mammotwin
