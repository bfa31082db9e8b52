#pragma once

#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/niftysim/niftysim_file.h"
#include "segmentation/image/volume.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

struct SqueezeOptions {
  double skin_thickness = 0;  ///< of the membrane [mm]; 0: none
  double grad_div = 5;        ///< SolidOptions::grad_div
  bool gravity = true;
  /// Roll of the chest-wall face about z [rad] at which the breast is held by a couple; free where
  /// not given.
  std::optional<double> roll;
};

struct Squeeze {
  std::string reason;  ///< why there is no equilibrium; empty where there is
  std::vector<HermiteMesh::Node> deformed;
  int dof = 0, steps = 0, iterations = 0;
  double min_J = 1, max_J = 1, volume_change = 0, penetration_mm = 0, force_N = 0, seconds = 0;
  double roll = 0;         ///< of the chest-wall face [rad], at the file's fixed nodes
  double couple_N_mm = 0;  ///< that holds the roll, about z
};

/// The file's own problem on another mesh: its plates (endless, frictionless), its gravity, its
/// bulk over shear modulus, the chest-wall face free in its plane; tissue from `tissue`. Nothing in
/// the file holds the breast sideways (x), and no force acts there: one point is held, and the
/// whole then shifted so that the centre of mass has not moved along x. Nothing holds its roll
/// about z either, see SqueezeOptions::roll.
Squeeze squeeze_between_plates(const MeshFile& mesh, const NiftySimModel& model,
                               const Volume<Fractions>& tissue, const SqueezeOptions& options);

}  // namespace mammotwin
