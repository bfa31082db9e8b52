#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "solver/breast/breast_problem.h"
#include "solver/load/skin_hold.h"
#include "solver/load/wall_surface.h"
#include "solver/newton/dof_map.h"
#include "solver/newton/model.h"

namespace mammotwin {

using Faces = std::vector<std::pair<int, int>>;  ///< (element, face)

/// A breast turned into energies and equations.
struct BreastModel {
  std::unique_ptr<Model> model;
  std::unique_ptr<DofMap> dofs;
  std::shared_ptr<WallSurface> wall;    ///< null if the chest wall is clamped
  std::shared_ptr<SkinHold> skin_hold;  ///< null where no skin is held
  Faces wall_faces;
  double largest_modulus = 0;  ///< of the tissue at the quadrature points [kPa]
  double element_size = 0;     ///< cube root of the mean element volume [mm]

  /// Of the dead forces on the skin and of what holds it, how much there is.
  void set_skin_share(double share);

  /// Shear modulus / element size [kPa/mm]: the unit of penalties.
  double penalty_unit() const { return largest_modulus / element_size; }
};

/// Throws std::invalid_argument that names what is wrong with the problem.
BreastModel make_breast_model(const BreastProblem& problem, const SolidOptions& solid);

Faces faces_labelled(const MeshFile& mesh, FaceLabel label);

}  // namespace mammotwin
