#pragma once

#include <string>
#include <vector>

#include "pipeline/validation/gel_cylinder/gel_cylinder_mesh.h"

namespace mammotwin {

/// The paper's gel cylinder (paper, section III), squeezed in four ways:
///   lateral       lying on its side between frictionless plates
///   plane_strain  the same with its end faces held in their planes
///   axial         standing, frictionless plates: a homogeneous state with a closed form. Past the
///                 first bifurcation (stretch 0.680), so arithmetic, not an experiment
///   bonded        standing, end faces stuck to the plates
enum class CylinderCase { lateral, plane_strain, axial, bonded };

/// Elements of an even mesh of the cylinder's eighth, as `CylinderExperiment::elements` wants them:
/// n along half the square's side, (n + 1) / 2 between square and mantle, n + 1 along the axis.
CylinderElements even_elements(int n);

struct CylinderExperiment {
  CylinderCase how = CylinderCase::lateral;
  double diameter = 29, length = 40;             ///< [mm]
  double c1 = 3;                                 ///< [kPa]
  double thickness = 17;                         ///< between the plates in the end [mm]
  CylinderPart part = CylinderPart::eighth;      ///< half: only lying
  CylinderElements elements = even_elements(2);  ///< whole cross-section (square even), half length
  int contact_points = 5;  ///< Gauss points a side on faces in contact, 4 to 10
  double penalty = 2e4;    ///< x shear modulus / element size
  /// The penalty raised from soft to `penalty` inside the load step, always (true) or only where
  /// the full penalty at once fails: one homogeneous gel under flat plates takes it in half the
  /// iterations.
  bool continued = false;
  bool with_condition = false;   ///< measure CylinderFigures::condition
  double gap_tolerance = 0.001;  ///< largest penetration [mm]; 0: the penalty as given
  int steps = 1;                 ///< load steps
};

/// What a load step ended with.
struct CylinderStep {
  double thickness_mm, force_N, half_width_middle_mm;
};

struct CylinderFigures {
  bool usable = false;
  std::string reason;
  double force_N = 0;               ///< of the whole cylinder
  double half_width_middle_mm = 0;  ///< deformed, at half length
  double half_width_end_mm = 0;     ///< the same at the end
  double half_length_axis_mm = 0;
  double penetration_mm = 0;
  double condition = 0;         ///< of the last tangent (condition_number.h); 0: not asked for
  double plate_work_mJ = 0;     ///< trapezoidal rule over the steps, whole cylinder
  double stored_energy_mJ = 0;  ///< of the whole cylinder, contact's part included
  double min_J = 1, max_J = 1;
  int dof = 0, elements = 0, iterations = 0;
  double seconds = 0, cpu_seconds = 0;  ///< CPU time is that of all threads
  std::vector<CylinderStep> history;
  MeshFile before{HermiteMesh({}, {}), {}, {}, {}, {}, {}};  ///< the part that is solved
  MeshFile after{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
};

/// Throws std::invalid_argument where a length is not positive or a count out of range.
CylinderFigures squeeze_cylinder(const CylinderExperiment& experiment);

}  // namespace mammotwin
