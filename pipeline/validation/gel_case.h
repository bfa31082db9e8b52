#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

namespace mammotwin {

/// Force and half width at a thickness on the way, as other codes have them.
struct GelCurvePoint {
  double thickness_mm = 0, force_N = 0;
  std::optional<double> half_width_middle_mm;
};

/// One file of sample_data/gel_cylinder/: an experiment and what other codes found.
struct GelCase {
  std::string name;                     ///< "lateral", "plane_strain", "axial", "bonded"
  CylinderExperiment experiment;        ///< on the recommended mesh, in one load step
  std::vector<CylinderElements> study;  ///< meshes from coarse to fine
  int curve_steps = 0;                  ///< load steps of the force-thickness curve; 0: none
  bool as_the_paper_ran_it = false;     ///< also with half the cylinder and one plate

  /// Converged values of other codes and their error; empty where there is none to compare with.
  std::optional<double> force_N, half_width_middle_mm, half_width_end_mm, half_length_axis_mm;
  double force_error_N = 0;
  std::vector<GelCurvePoint> curve;

  /// What the recommended mesh has to reach: fraction, [mm], fraction of the radial strain.
  std::optional<double> force_target, length_target_mm, radial_strain_target;

  double radius_mm() const { return experiment.diameter / 2; }
};

/// Throws std::runtime_error that names file, key, what was expected and what was found.
GelCase read_gel_case(const std::filesystem::path& file);

}  // namespace mammotwin
