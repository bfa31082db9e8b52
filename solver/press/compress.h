#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/contact/plate_friction.h"
#include "solver/contact/plate_placement.h"
#include "solver/element/solid_element.h"
#include "solver/material/mixture.h"
#include "solver/newton/model.h"

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

/// With the plates (contact/plate_friction.h).
struct FrictionOptions {
  double coefficient = 0;  ///< in [0, 1]; 0: none
  double slip = 0.1;       ///< a point sticks until it slid so far [mm] > 0
};

/// One breast between two plates. The solver knows nothing of views: the plates say which way.
struct CompressionProblem {
  /// The shape that is free of stress, with face labels.
  MeshFile mesh{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  /// The breast as imaged: where tissue is sampled and the chest wall stands; empty: the mesh.
  std::vector<HermiteMesh::Node> prone;
  TissueSampler tissue;
  TissueLaws laws = TissueLaws::defaults();
  SkinOptions skin;
  BoundaryOptions boundary;
  FrictionOptions friction;
  PlateOptions plates;
  /// [mm/s²]; where it is not zero the breast first comes to rest under it, then plates close.
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  double density = 1e-6;  ///< [kg/mm³] > 0
};

enum class Moving {
  both,   ///< plates close on the breast from both sides
  paddle  ///< the support first lifts the breast to its place, then only the paddle moves
};

struct CompressionOptions {
  SolidOptions solid;
  Moving moving = Moving::both;
  double gap_tolerance = 0.08;        ///< largest penetration [mm] > 0
  double thickness_tolerance = 0.05;  ///< |measured − asked| [mm] > 0
  double first_step = 1;              ///< of the way, in (0, 1]
  double longest_move = 10;           ///< of a plate in one load step [mm] > 0
  double smallest_step = 1.0 / 64;    ///< give up below this part of the way
  int max_iterations = 500;           ///< Newton iterations of the load steps together
  /// Of the tissue in front of the plates' edges, in [0, 1): where less stays there the breast
  /// counts as slipped out.
  double least_retained = 0.5;
  /// In `compress_from`: friction's tractions stay those of the result that it starts from, but for
  /// springs of this reach [mm] > 0 (PlateFriction::freeze); 0: they follow Coulomb's law.
  double frozen_friction = 0;
};

struct CompressionStep {
  double thickness_mm = 0;  ///< measured
  double force_N = 0;       ///< of the paddle
  int iterations = 0;
  double penalty = 0;  ///< [kPa/mm]
  double min_J = 1, max_J = 1;
  std::vector<HermiteMesh::Node> deformed;
};

enum class CompressionStatus { converged, not_converged };

struct CompressionReport {
  CompressionStatus status = CompressionStatus::not_converged;
  std::string reason;  ///< why not, with the last good thickness
  int steps = 0, cutbacks = 0, newton_iterations = 0, indefinite_matrices = 0;
  double target_thickness_mm = 0;
  double thickness_mm = 0;       ///< extent along `up` of the deformed skin between the plates
  double free_thickness_mm = 0;  ///< the same of the uncompressed breast
  double force_N = 0;            ///< of the paddle, from contact
  double energy_force_N = 0;     ///< the same from the change of stored energy, a check
  double paddle_tilt_deg = 0;    ///< in the end
  double contact_area_cm2 = 0;   ///< deformed, within 0.1 mm of the paddle
  double gap_p95_mm = 0;         ///< of the skin to both plates where they press (pressed_gap.h)
  double volume_change = 0;      ///< fraction
  double min_J = 1, max_J = 1;
  double J_within_half = 0;  ///< fraction of quadrature points with J in [0.5, 1.5]
  double max_penetration_mm = 0;
  double retained_fraction = 1;  ///< of the tissue in front of the plates' edges, how much stays
  bool slipped_out = false;      ///< backwards from between the plates
  double wall_gap_mm = 0;        ///< most that the chest-wall face left its distance to the wall
  double seconds = 0;
  int dof = 0;
  std::vector<CompressionStep> history;
  bool usable() const { return status == CompressionStatus::converged; }
};

struct CompressionResult {
  std::vector<HermiteMesh::Node> deformed;   ///< at the last good step
  std::vector<HermiteMesh::Node> found;      ///< as the plates found the breast: at rest
  std::vector<double> pressure;              ///< 8 an element (State::pressure)
  PlacedPlates plates;                       ///< where they ended
  double penalty = 0;                        ///< of contact in the end [kPa/mm]
  std::vector<PlateFriction::Hold> holds;    ///< of friction in the end; empty without
  std::map<std::string, PointField> fields;  ///< press/solution_fields.h; empty if not usable
  CompressionReport report;
};

struct CompressionCheckpoint;

/// How a compression that was interrupted goes on (press/checkpoint.h).
struct CompressionRestart {
  const CompressionCheckpoint* from = nullptr;  ///< of the same problem; null: anew
  std::function<void(const CompressionCheckpoint&)>
      keep;  ///< called after each load step; or empty
};

using Progress = std::function<void(double fraction, const std::string& what)>;

/// Squeezes the breast between support and paddle to the thickness asked.
///
/// Throws std::invalid_argument that names the cause where the problem cannot be posed: folded
/// mesh, stiffness not positive, a number that is not finite, a thickness that is not between 0 and
/// the breast's, plates that never touch, nothing that holds the body. Where no equilibrium is
/// found the report says why and how far it came.
CompressionResult compress(const CompressionProblem& problem, const CompressionOptions& options,
                           const Progress& progress = {}, const CompressionRestart& restart = {});

/// The same from the result of a slightly different problem on the same mesh (thickness, plates'
/// place, stiffness), in a tenth of the iterations; it stays on that result's branch of equilibria.
/// `energy_force_N` is not computed. Friction holds it as it held that result.
CompressionResult compress_from(const CompressionResult& near, const CompressionProblem& problem,
                                const CompressionOptions& options);

}  // namespace mammotwin
