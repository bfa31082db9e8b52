#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/breast/pressed_skin.h"
#include "solver/element/dead_forces.h"
#include "solver/material/mixture.h"

namespace mammotwin {

/// Fractions of fat, fibroglandular and lesion (they sum to 1) near a prone position [mm], averaged
/// over the volume [mm³] that a quadrature point stands for.
using TissueSampler =
    std::function<std::array<double, 3>(const Eigen::Vector3d& x_prone, double volume_mm3)>;

/// Laws of fat, fibroglandular and lesion, and how one quadrature point's tissues share its strain.
struct TissueLaws {
  Mixture::Laws laws;
  Mixing mixing = Mixing::geometric;

  /// Neo-Hookean, c₁ 0.75, 2.5 and 3.3 kPa (design, section 3).
  static TissueLaws defaults();
};

/// A membrane whose c1 is the skin's less that of fat, which the solid has in the skin's place
/// (half its shear modulus at rest); skin no stiffer than fat has none.
struct SkinOptions {
  bool on = true;
  double c1 = 3.3;         ///< [kPa] > 0
  double thickness = 1.5;  ///< [mm] > 0
  double stiffening = 0;   ///< b >= 0 of its law (SkinMembrane); 0: neo-Hookean
};

enum class ChestWall {
  sliding,  ///< held on the undeformed wall's surface, sliding against springs
  free,     ///< held on the surface, sliding freely
  clamped
};
enum class CutFaces {
  springs,  ///< in all three directions: tissue goes on behind the cut
  free,
  clamped
};

struct BoundaryOptions {
  ChestWall chest_wall = ChestWall::sliding;
  double chest_wall_spring = 0.08;  ///< [kPa/mm] >= 0, for `sliding`
  /// [mm] > 0: about so far the springs give way before they stiffen (SpringBed); empty: linear.
  std::optional<double> chest_wall_reach;
  /// ℓ [mm] >= 0 of the smooth wall that the breast slides along (with_smooth_wall); 0: the fitted
  /// one, with its hollows.
  double wall_smoothing = 0;
  CutFaces cut_faces = CutFaces::springs;
  double cut_face_depth = 50;            ///< [mm] > 0: spring = shear modulus / this, for `springs`
  std::optional<double> cut_face_reach;  ///< [mm] > 0, as of the chest wall
};

/// One breast: its shape, what it is made of, what holds it and its weight.
struct BreastProblem {
  /// The shape that is free of stress, with face labels; `unload` takes the imaged one instead.
  MeshFile mesh{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  /// The breast as imaged: where tissue is sampled and the chest wall stands; empty: the mesh.
  std::vector<HermiteMesh::Node> prone;
  TissueSampler tissue;
  TissueLaws laws = TissueLaws::defaults();
  SkinOptions skin;
  BoundaryOptions boundary;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [mm/s²]
  double density = 1e-6;                              ///< [kg/mm³] > 0
  PressedSkin pressed;     ///< of the imaged skin; there it is held (SkinHold), too
  DeadForces skin_forces;  ///< of what presses it; empty: none
};

}  // namespace mammotwin
